/* The kernel inverse_dynamics of tm5_700. Made by `cga generate`; do not edit: the loader checks digests, and the next run overwrites it. */

#include <math.h>
#include <stdint.h>

#ifdef _WIN32
#define CGA_EXPORT __declspec(dllexport)
#else
#define CGA_EXPORT
#endif

/* 0 * x is zero for every finite x, and NaN for NaN and infinity. */
static inline int cga_not_finite(const double *x, int n)
{
    double zero = 0.0;
    for (int i = 0; i < n; ++i)
        zero += 0.0 * x[i];
    return zero != 0.0;
}

#if defined(__GNUC__)
#define CGA_NOINLINE __attribute__((noinline))
#else
#define CGA_NOINLINE
#endif

/* T is the number type of the bodies, K(x) a constant of that type, ROOT(x) a square root. */
#ifndef T
#define T double
#define K(x) (x)
#define ROOT(x) sqrt(x)
#endif

/* tau = M(q) a + C(q, v) v + g(q), by recursive Newton-Euler (N m, N). From cga_codegen.kernels.dynamics.inverse_dynamics.
   187 mul, 153 add, 0 div, 0 sqrt. */
static inline void cga_tm5_700_tree_inverse_dynamics_body(const T *restrict c, const T *restrict s, const T *restrict v, const T *restrict a, T *restrict out)
{
    const T t0 = K(0.007359472) * a[0];
    const T t1 = a[0] * K(0.004610609000000002);
    const T t2 = t0 + t1;
    const T t3 = s[1] * v[0];
    const T t4 = t3 * v[1];
    const T t5 = a[0] * c[1];
    const T t6 = t5 - t4;
    const T t7 = t4 - t6;
    const T t8 = K(0.014946320999999999) * t7;
    const T t9 = t5 * K(0.008605751000000009);
    const T t10 = t8 - t9;
    const T t11 = t6 * c[2];
    const T t12 = a[0] * s[1];
    const T t13 = c[1] * v[0];
    const T t14 = v[1] * t13;
    const T t15 = t12 + t14;
    const T t16 = s[2] * t15;
    const T t17 = t11 - t16;
    const T t18 = t3 * c[2];
    const T t19 = s[2] * t13;
    const T t20 = t18 + t19;
    const T t21 = t20 * v[2];
    const T t22 = t17 - t21;
    const T t23 = v[1] + v[2];
    const T t24 = t20 * t23;
    const T t25 = t22 - t24;
    const T t26 = K(0.001939620000000003) * t25;
    const T t27 = t22 + t24;
    const T t28 = K(0.001440561) * t27;
    const T t29 = t26 + t28;
    const T t30 = t20 * s[3];
    const T t31 = c[2] * t13;
    const T t32 = t3 * s[2];
    const T t33 = t31 - t32;
    const T t34 = c[3] * t33;
    const T t35 = t30 - t34;
    const T t36 = t23 + v[3];
    const T t37 = t35 * t36;
    const T t38 = t35 * v[3];
    const T t39 = c[2] * t15;
    const T t40 = t6 * s[2];
    const T t41 = t39 + t40;
    const T t42 = v[2] * t33;
    const T t43 = t41 + t42;
    const T t44 = c[3] * t43;
    const T t45 = t22 * s[3];
    const T t46 = t44 + t45;
    const T t47 = t38 - t46;
    const T t48 = t37 + t47;
    const T t49 = K(0.0010692680000000002) * t48;
    const T t50 = t37 - t47;
    const T t51 = K(0.0009891370000000002) * t50;
    const T t52 = t49 - t51;
    const T t53 = t36 * c[4];
    const T t54 = t20 * c[3];
    const T t55 = s[3] * t33;
    const T t56 = t54 + t55;
    const T t57 = s[4] * t56;
    const T t58 = t53 + t57;
    const T t59 = t35 - v[4];
    const T t60 = t58 * t59;
    const T t61 = t47 * c[4];
    const T t62 = a[1] + a[2];
    const T t63 = t62 + a[3];
    const T t64 = s[4] * t63;
    const T t65 = t61 + t64;
    const T t66 = t58 * v[4];
    const T t67 = t65 + t66;
    const T t68 = t60 - t67;
    const T t69 = K(0.0010692680000000002) * t68;
    const T t70 = t60 + t67;
    const T t71 = K(0.0009891370000000002) * t70;
    const T t72 = t69 - t71;
    const T t73 = t59 * c[5];
    const T t74 = t36 * s[4];
    const T t75 = c[4] * t56;
    const T t76 = t74 - t75;
    const T t77 = s[5] * t76;
    const T t78 = t73 + t77;
    const T t79 = t58 - v[5];
    const T t80 = t78 * t79;
    const T t81 = t67 * c[5];
    const T t82 = s[3] * t43;
    const T t83 = t22 * c[3];
    const T t84 = t82 - t83;
    const T t85 = v[3] * t56;
    const T t86 = t84 + t85;
    const T t87 = a[4] - t86;
    const T t88 = s[5] * t87;
    const T t89 = t81 + t88;
    const T t90 = t78 * v[5];
    const T t91 = t89 - t90;
    const T t92 = t80 + t91;
    const T t93 = K(0.00047511449999999996) * t92;
    const T t94 = t80 - t91;
    const T t95 = K(0.0002994294999999999) * t94;
    const T t96 = t93 - t95;
    const T t97 = c[5] * t96;
    const T t98 = c[5] * t76;
    const T t99 = t59 * s[5];
    const T t100 = t98 - t99;
    const T t101 = t79 * t100;
    const T t102 = c[5] * t87;
    const T t103 = t67 * s[5];
    const T t104 = t102 - t103;
    const T t105 = v[5] * t100;
    const T t106 = t104 - t105;
    const T t107 = t101 - t106;
    const T t108 = K(0.0002994294999999999) * t107;
    const T t109 = t101 + t106;
    const T t110 = K(0.0010843815) * t109;
    const T t111 = t108 - t110;
    const T t112 = s[5] * t111;
    const T t113 = t97 + t112;
    const T t114 = t3 * t13;
    const T t115 = a[1] - t114;
    const T t116 = K(0.329) * t115;
    const T t117 = s[1] * K(9.81);
    const T t118 = t116 - t117;
    const T t119 = c[2] * t118;
    const T t120 = c[1] * K(9.81);
    const T t121 = t3 * t3;
    const T t122 = v[1] * v[1];
    const T t123 = t121 + t122;
    const T t124 = K(0.329) * t123;
    const T t125 = t120 - t124;
    const T t126 = s[2] * t125;
    const T t127 = t119 - t126;
    const T t128 = t20 * t33;
    const T t129 = t62 - t128;
    const T t130 = K(0.3115) * t129;
    const T t131 = t27 * K(0.1223);
    const T t132 = t130 + t131;
    const T t133 = t127 + t132;
    const T t134 = c[3] * t133;
    const T t135 = c[2] * t125;
    const T t136 = s[2] * t118;
    const T t137 = t135 + t136;
    const T t138 = t23 * t33;
    const T t139 = t43 - t138;
    const T t140 = K(0.1223) * t139;
    const T t141 = t20 * t20;
    const T t142 = t23 * t23;
    const T t143 = t141 + t142;
    const T t144 = K(0.3115) * t143;
    const T t145 = t140 - t144;
    const T t146 = t137 + t145;
    const T t147 = s[3] * t146;
    const T t148 = t134 - t147;
    const T t149 = t35 * t56;
    const T t150 = t63 + t149;
    const T t151 = K(0.106) * t150;
    const T t152 = t148 + t151;
    const T t153 = c[4] * t152;
    const T t154 = t14 + t15;
    const T t155 = K(0.329) * t154;
    const T t156 = t43 + t138;
    const T t157 = K(0.3115) * t156;
    const T t158 = t33 * t33;
    const T t159 = t141 + t158;
    const T t160 = K(0.1223) * t159;
    const T t161 = t157 + t160;
    const T t162 = t155 + t161;
    const T t163 = t48 * K(0.106);
    const T t164 = t162 - t163;
    const T t165 = s[4] * t164;
    const T t166 = t153 + t165;
    const T t167 = t58 * t76;
    const T t168 = t87 - t167;
    const T t169 = K(0.11315) * t168;
    const T t170 = t166 + t169;
    const T t171 = c[5] * t170;
    const T t172 = c[3] * t146;
    const T t173 = s[3] * t133;
    const T t174 = t172 + t173;
    const T t175 = t56 * t56;
    const T t176 = t36 * t36;
    const T t177 = t175 + t176;
    const T t178 = K(0.106) * t177;
    const T t179 = t174 - t178;
    const T t180 = t68 * K(0.11315);
    const T t181 = t179 + t180;
    const T t182 = s[5] * t181;
    const T t183 = t171 + t182;
    const T t184 = K(0.65) * t183;
    const T t185 = s[5] * t184;
    const T t186 = c[5] * t181;
    const T t187 = s[5] * t170;
    const T t188 = t186 - t187;
    const T t189 = K(0.65) * t188;
    const T t190 = c[5] * t189;
    const T t191 = t185 + t190;
    const T t192 = K(0.11315) * t191;
    const T t193 = t113 - t192;
    const T t194 = t72 - t193;
    const T t195 = c[4] * t194;
    const T t196 = t59 * t76;
    const T t197 = c[4] * t63;
    const T t198 = t47 * s[4];
    const T t199 = t197 - t198;
    const T t200 = v[4] * t76;
    const T t201 = t199 - t200;
    const T t202 = t196 - t201;
    const T t203 = K(0.0009891370000000002) * t202;
    const T t204 = t196 + t201;
    const T t205 = K(0.0015739419999999996) * t204;
    const T t206 = t203 - t205;
    const T t207 = t78 * t100;
    const T t208 = t201 - a[5];
    const T t209 = t207 + t208;
    const T t210 = K(0.0010843815) * t209;
    const T t211 = t207 - t208;
    const T t212 = K(0.00047511449999999996) * t211;
    const T t213 = t210 - t212;
    const T t214 = t206 - t213;
    const T t215 = s[4] * t214;
    const T t216 = t195 - t215;
    const T t217 = t166 * K(1.576);
    const T t218 = c[5] * t184;
    const T t219 = s[5] * t189;
    const T t220 = t218 - t219;
    const T t221 = t217 + t220;
    const T t222 = s[4] * t221;
    const T t223 = c[4] * t164;
    const T t224 = s[4] * t152;
    const T t225 = t223 - t224;
    const T t226 = K(1.576) * t225;
    const T t227 = t76 * t76;
    const T t228 = t59 * t59;
    const T t229 = t227 + t228;
    const T t230 = K(0.11315) * t229;
    const T t231 = t225 + t230;
    const T t232 = K(0.65) * t231;
    const T t233 = t226 + t232;
    const T t234 = c[4] * t233;
    const T t235 = t222 + t234;
    const T t236 = K(0.106) * t235;
    const T t237 = t216 + t236;
    const T t238 = t52 - t237;
    const T t239 = s[3] * t238;
    const T t240 = t36 * t56;
    const T t241 = t86 - t240;
    const T t242 = K(0.0009891370000000002) * t241;
    const T t243 = t86 + t240;
    const T t244 = K(0.0015739419999999996) * t243;
    const T t245 = t242 + t244;
    const T t246 = t87 + t167;
    const T t247 = K(0.0015739419999999996) * t246;
    const T t248 = K(0.0010692680000000002) * t168;
    const T t249 = t247 + t248;
    const T t250 = s[5] * t96;
    const T t251 = c[5] * t111;
    const T t252 = t250 - t251;
    const T t253 = K(0.11315) * t220;
    const T t254 = t252 + t253;
    const T t255 = t249 + t254;
    const T t256 = t245 - t255;
    const T t257 = c[3] * t256;
    const T t258 = t239 + t257;
    const T t259 = t148 * K(1.576);
    const T t260 = c[4] * t221;
    const T t261 = s[4] * t233;
    const T t262 = t260 - t261;
    const T t263 = t259 + t262;
    const T t264 = c[3] * t263;
    const T t265 = t174 * K(1.576);
    const T t266 = t179 * K(1.576);
    const T t267 = t191 + t266;
    const T t268 = t265 + t267;
    const T t269 = s[3] * t268;
    const T t270 = t264 + t269;
    const T t271 = K(0.1223) * t270;
    const T t272 = t258 - t271;
    const T t273 = t29 - t272;
    const T t274 = c[2] * t273;
    const T t275 = K(0.001440561) * t139;
    const T t276 = t156 * K(0.032388583000000006);
    const T t277 = t275 + t276;
    const T t278 = c[3] * t238;
    const T t279 = s[3] * t256;
    const T t280 = t278 - t279;
    const T t281 = s[3] * t263;
    const T t282 = c[3] * t268;
    const T t283 = t281 - t282;
    const T t284 = K(0.1223) * t283;
    const T t285 = t162 * K(1.576);
    const T t286 = t235 + t285;
    const T t287 = K(0.3115) * t286;
    const T t288 = t284 - t287;
    const T t289 = t280 + t288;
    const T t290 = t277 - t289;
    const T t291 = s[2] * t290;
    const T t292 = t274 + t291;
    const T t293 = t10 - t292;
    const T t294 = c[1] * t293;
    const T t295 = s[2] * t273;
    const T t296 = c[2] * t290;
    const T t297 = t295 - t296;
    const T t298 = t154 * K(0.7478170000000001);
    const T t299 = t286 + t298;
    const T t300 = K(0.329) * t299;
    const T t301 = t297 - t300;
    const T t302 = K(0.008605751000000009) * t12;
    const T t303 = t154 * K(0.189646219);
    const T t304 = t302 + t303;
    const T t305 = t301 - t304;
    const T t306 = s[1] * t305;
    const T t307 = t294 + t306;
    const T t308 = t2 - t307;
    const T t309 = t115 * K(0.189646219);
    const T t310 = a[1] + t114;
    const T t311 = K(0.014946320999999999) * t310;
    const T t312 = t309 + t311;
    const T t313 = t129 * K(0.032388583000000006);
    const T t314 = t62 + t128;
    const T t315 = K(0.001939620000000003) * t314;
    const T t316 = t313 + t315;
    const T t317 = t63 - t149;
    const T t318 = K(0.0015739419999999996) * t317;
    const T t319 = K(0.0010692680000000002) * t150;
    const T t320 = t318 + t319;
    const T t321 = s[4] * t194;
    const T t322 = c[4] * t214;
    const T t323 = t321 + t322;
    const T t324 = K(0.106) * t262;
    const T t325 = t323 - t324;
    const T t326 = t320 - t325;
    const T t327 = K(0.3115) * t270;
    const T t328 = t326 + t327;
    const T t329 = t316 + t328;
    const T t330 = t137 * K(2.273);
    const T t331 = t283 - t330;
    const T t332 = s[2] * t331;
    const T t333 = t127 * K(2.273);
    const T t334 = t270 + t333;
    const T t335 = c[2] * t334;
    const T t336 = t332 - t335;
    const T t337 = K(0.329) * t336;
    const T t338 = t329 - t337;
    const T t339 = t312 + t338;
    out[0] = t308;
    out[1] = t339;
    out[2] = t329;
    out[3] = t326;
    out[4] = t255;
    out[5] = -t213;
}

CGA_EXPORT int cga_tm5_700_tree_inverse_dynamics(const double *restrict q /* 6 */, const double *restrict v /* 6 */, const double *restrict a /* 6 */, double *restrict out /* 6 */)
{
    double c[6], s[6];
    for (int j = 0; j < 6; ++j) { c[j] = cos(q[j]); s[j] = sin(q[j]); }
    cga_tm5_700_tree_inverse_dynamics_body(c, s, v, a, out);
    return cga_not_finite(q, 6) || cga_not_finite(v, 6) || cga_not_finite(a, 6);
}

CGA_EXPORT int cga_tm5_700_tree_inverse_dynamics_batch(int64_t n, const double *restrict q /* 6 */, const double *restrict v /* 6 */, const double *restrict a /* 6 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_tm5_700_tree_inverse_dynamics(q + k * 6, v + k * 6, a + k * 6, out + k * 6);
    return bad;
}
