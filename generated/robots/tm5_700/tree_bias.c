/* The kernel bias of tm5_700. Made by `cga generate`; do not edit: the loader checks digests, and the next run overwrites it. */

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

/* C(q, v) v + g(q): inverse dynamics without acceleration (Pinocchio's nonLinearEffects). From cga_codegen.kernels.dynamics.bias.
   179 mul, 133 add, 0 div, 0 sqrt. */
static inline void cga_tm5_700_tree_bias_body(const T *restrict c, const T *restrict s, const T *restrict v, T *restrict out)
{
    const T t0 = s[1] * v[0];
    const T t1 = t0 * v[1];
    const T t2 = K(0.029892641999999997) * t1;
    const T t3 = t0 * c[2];
    const T t4 = c[1] * v[0];
    const T t5 = s[2] * t4;
    const T t6 = t3 + t5;
    const T t7 = v[1] + v[2];
    const T t8 = t6 * t7;
    const T t9 = t1 * c[2];
    const T t10 = v[1] * t4;
    const T t11 = s[2] * t10;
    const T t12 = t9 + t11;
    const T t13 = t6 * v[2];
    const T t14 = t12 + t13;
    const T t15 = t8 + t14;
    const T t16 = K(0.001939620000000003) * t15;
    const T t17 = t8 - t14;
    const T t18 = K(0.001440561) * t17;
    const T t19 = t16 - t18;
    const T t20 = t6 * s[3];
    const T t21 = c[2] * t4;
    const T t22 = t0 * s[2];
    const T t23 = t21 - t22;
    const T t24 = c[3] * t23;
    const T t25 = t20 - t24;
    const T t26 = t7 + v[3];
    const T t27 = t25 * t26;
    const T t28 = t1 * s[2];
    const T t29 = c[2] * t10;
    const T t30 = t28 - t29;
    const T t31 = v[2] * t23;
    const T t32 = t30 - t31;
    const T t33 = c[3] * t32;
    const T t34 = t14 * s[3];
    const T t35 = t33 + t34;
    const T t36 = t25 * v[3];
    const T t37 = t35 + t36;
    const T t38 = t27 + t37;
    const T t39 = K(0.0010692680000000002) * t38;
    const T t40 = t27 - t37;
    const T t41 = K(0.0009891370000000002) * t40;
    const T t42 = t39 - t41;
    const T t43 = t26 * c[4];
    const T t44 = t6 * c[3];
    const T t45 = s[3] * t23;
    const T t46 = t44 + t45;
    const T t47 = s[4] * t46;
    const T t48 = t43 + t47;
    const T t49 = t25 - v[4];
    const T t50 = t48 * t49;
    const T t51 = t37 * c[4];
    const T t52 = t48 * v[4];
    const T t53 = t51 + t52;
    const T t54 = t50 - t53;
    const T t55 = K(0.0010692680000000002) * t54;
    const T t56 = t50 + t53;
    const T t57 = K(0.0009891370000000002) * t56;
    const T t58 = t55 - t57;
    const T t59 = t49 * c[5];
    const T t60 = t26 * s[4];
    const T t61 = c[4] * t46;
    const T t62 = t60 - t61;
    const T t63 = s[5] * t62;
    const T t64 = t59 + t63;
    const T t65 = t48 - v[5];
    const T t66 = t64 * t65;
    const T t67 = t53 * c[5];
    const T t68 = t14 * c[3];
    const T t69 = s[3] * t32;
    const T t70 = t68 - t69;
    const T t71 = v[3] * t46;
    const T t72 = t70 + t71;
    const T t73 = s[5] * t72;
    const T t74 = t67 - t73;
    const T t75 = t64 * v[5];
    const T t76 = t74 - t75;
    const T t77 = t66 + t76;
    const T t78 = K(0.00047511449999999996) * t77;
    const T t79 = t66 - t76;
    const T t80 = K(0.0002994294999999999) * t79;
    const T t81 = t78 - t80;
    const T t82 = c[5] * t81;
    const T t83 = c[5] * t62;
    const T t84 = t49 * s[5];
    const T t85 = t83 - t84;
    const T t86 = t65 * t85;
    const T t87 = c[5] * t72;
    const T t88 = t53 * s[5];
    const T t89 = t87 + t88;
    const T t90 = v[5] * t85;
    const T t91 = t89 + t90;
    const T t92 = t86 + t91;
    const T t93 = K(0.0002994294999999999) * t92;
    const T t94 = t86 - t91;
    const T t95 = K(0.0010843815) * t94;
    const T t96 = t93 - t95;
    const T t97 = s[5] * t96;
    const T t98 = t82 + t97;
    const T t99 = t17 * K(0.1223);
    const T t100 = t6 * t23;
    const T t101 = K(0.3115) * t100;
    const T t102 = t99 - t101;
    const T t103 = s[1] * K(9.81);
    const T t104 = t0 * t4;
    const T t105 = K(0.329) * t104;
    const T t106 = t103 + t105;
    const T t107 = c[2] * t106;
    const T t108 = c[1] * K(9.81);
    const T t109 = t0 * t0;
    const T t110 = v[1] * v[1];
    const T t111 = t109 + t110;
    const T t112 = K(0.329) * t111;
    const T t113 = t108 - t112;
    const T t114 = s[2] * t113;
    const T t115 = t107 + t114;
    const T t116 = t102 - t115;
    const T t117 = c[3] * t116;
    const T t118 = c[2] * t113;
    const T t119 = s[2] * t106;
    const T t120 = t118 - t119;
    const T t121 = t7 * t23;
    const T t122 = t32 + t121;
    const T t123 = K(0.1223) * t122;
    const T t124 = t6 * t6;
    const T t125 = t7 * t7;
    const T t126 = t124 + t125;
    const T t127 = K(0.3115) * t126;
    const T t128 = t123 + t127;
    const T t129 = t120 - t128;
    const T t130 = s[3] * t129;
    const T t131 = t117 - t130;
    const T t132 = t25 * t46;
    const T t133 = K(0.106) * t132;
    const T t134 = t131 + t133;
    const T t135 = c[4] * t134;
    const T t136 = t10 * K(0.658);
    const T t137 = t32 - t121;
    const T t138 = K(0.3115) * t137;
    const T t139 = t23 * t23;
    const T t140 = t124 + t139;
    const T t141 = K(0.1223) * t140;
    const T t142 = t138 - t141;
    const T t143 = t136 - t142;
    const T t144 = t38 * K(0.106);
    const T t145 = t143 - t144;
    const T t146 = s[4] * t145;
    const T t147 = t135 + t146;
    const T t148 = t48 * t62;
    const T t149 = t72 + t148;
    const T t150 = K(0.11315) * t149;
    const T t151 = t147 - t150;
    const T t152 = c[5] * t151;
    const T t153 = c[3] * t129;
    const T t154 = s[3] * t116;
    const T t155 = t153 + t154;
    const T t156 = t46 * t46;
    const T t157 = t26 * t26;
    const T t158 = t156 + t157;
    const T t159 = K(0.106) * t158;
    const T t160 = t155 - t159;
    const T t161 = t54 * K(0.11315);
    const T t162 = t160 + t161;
    const T t163 = s[5] * t162;
    const T t164 = t152 + t163;
    const T t165 = K(0.65) * t164;
    const T t166 = s[5] * t165;
    const T t167 = c[5] * t162;
    const T t168 = s[5] * t151;
    const T t169 = t167 - t168;
    const T t170 = K(0.65) * t169;
    const T t171 = c[5] * t170;
    const T t172 = t166 + t171;
    const T t173 = K(0.11315) * t172;
    const T t174 = t98 - t173;
    const T t175 = t58 - t174;
    const T t176 = c[4] * t175;
    const T t177 = t49 * t62;
    const T t178 = t37 * s[4];
    const T t179 = v[4] * t62;
    const T t180 = t178 + t179;
    const T t181 = t177 + t180;
    const T t182 = K(0.0009891370000000002) * t181;
    const T t183 = t177 - t180;
    const T t184 = K(0.0015739419999999996) * t183;
    const T t185 = t182 - t184;
    const T t186 = t64 * t85;
    const T t187 = t180 - t186;
    const T t188 = K(0.0010843815) * t187;
    const T t189 = t180 + t186;
    const T t190 = K(0.00047511449999999996) * t189;
    const T t191 = t188 + t190;
    const T t192 = t185 + t191;
    const T t193 = s[4] * t192;
    const T t194 = t176 - t193;
    const T t195 = t147 * K(1.576);
    const T t196 = c[5] * t165;
    const T t197 = s[5] * t170;
    const T t198 = t196 - t197;
    const T t199 = t195 + t198;
    const T t200 = s[4] * t199;
    const T t201 = c[4] * t145;
    const T t202 = s[4] * t134;
    const T t203 = t201 - t202;
    const T t204 = K(1.576) * t203;
    const T t205 = t62 * t62;
    const T t206 = t49 * t49;
    const T t207 = t205 + t206;
    const T t208 = K(0.11315) * t207;
    const T t209 = t203 + t208;
    const T t210 = K(0.65) * t209;
    const T t211 = t204 + t210;
    const T t212 = c[4] * t211;
    const T t213 = t200 + t212;
    const T t214 = K(0.106) * t213;
    const T t215 = t194 + t214;
    const T t216 = t42 - t215;
    const T t217 = s[3] * t216;
    const T t218 = t26 * t46;
    const T t219 = t72 - t218;
    const T t220 = K(0.0009891370000000002) * t219;
    const T t221 = t72 + t218;
    const T t222 = K(0.0015739419999999996) * t221;
    const T t223 = t220 + t222;
    const T t224 = t72 - t148;
    const T t225 = K(0.0015739419999999996) * t224;
    const T t226 = K(0.0010692680000000002) * t149;
    const T t227 = t225 + t226;
    const T t228 = s[5] * t81;
    const T t229 = c[5] * t96;
    const T t230 = t228 - t229;
    const T t231 = K(0.11315) * t198;
    const T t232 = t230 + t231;
    const T t233 = t227 - t232;
    const T t234 = t223 + t233;
    const T t235 = c[3] * t234;
    const T t236 = t217 + t235;
    const T t237 = t131 * K(1.576);
    const T t238 = c[4] * t199;
    const T t239 = s[4] * t211;
    const T t240 = t238 - t239;
    const T t241 = t237 + t240;
    const T t242 = c[3] * t241;
    const T t243 = t155 * K(1.576);
    const T t244 = t160 * K(1.576);
    const T t245 = t172 + t244;
    const T t246 = t243 + t245;
    const T t247 = s[3] * t246;
    const T t248 = t242 + t247;
    const T t249 = K(0.1223) * t248;
    const T t250 = t236 - t249;
    const T t251 = t19 + t250;
    const T t252 = c[2] * t251;
    const T t253 = K(0.001440561) * t122;
    const T t254 = t137 * K(0.032388583000000006);
    const T t255 = t253 + t254;
    const T t256 = c[3] * t216;
    const T t257 = s[3] * t234;
    const T t258 = t256 - t257;
    const T t259 = s[3] * t241;
    const T t260 = c[3] * t246;
    const T t261 = t259 - t260;
    const T t262 = K(0.1223) * t261;
    const T t263 = t143 * K(1.576);
    const T t264 = t213 + t263;
    const T t265 = K(0.3115) * t264;
    const T t266 = t262 - t265;
    const T t267 = t258 + t266;
    const T t268 = t255 + t267;
    const T t269 = s[2] * t268;
    const T t270 = t252 + t269;
    const T t271 = t2 + t270;
    const T t272 = c[1] * t271;
    const T t273 = c[2] * t268;
    const T t274 = s[2] * t251;
    const T t275 = t273 - t274;
    const T t276 = t10 * K(1.4956340000000001);
    const T t277 = t264 + t276;
    const T t278 = K(0.329) * t277;
    const T t279 = t275 - t278;
    const T t280 = t10 * K(0.379292438);
    const T t281 = t279 - t280;
    const T t282 = s[1] * t281;
    const T t283 = t272 + t282;
    const T t284 = t104 * K(0.014946320999999999);
    const T t285 = t104 * K(0.189646219);
    const T t286 = t284 - t285;
    const T t287 = K(0.001939620000000003) * t100;
    const T t288 = t100 * K(0.032388583000000006);
    const T t289 = t287 - t288;
    const T t290 = K(0.0010692680000000002) * t132;
    const T t291 = t132 * K(0.0015739419999999996);
    const T t292 = t290 - t291;
    const T t293 = s[4] * t175;
    const T t294 = c[4] * t192;
    const T t295 = t293 + t294;
    const T t296 = K(0.106) * t240;
    const T t297 = t295 - t296;
    const T t298 = t292 - t297;
    const T t299 = K(0.3115) * t248;
    const T t300 = t298 + t299;
    const T t301 = t289 + t300;
    const T t302 = t120 * K(2.273);
    const T t303 = t261 - t302;
    const T t304 = s[2] * t303;
    const T t305 = t115 * K(2.273);
    const T t306 = t248 - t305;
    const T t307 = c[2] * t306;
    const T t308 = t304 - t307;
    const T t309 = K(0.329) * t308;
    const T t310 = t301 - t309;
    const T t311 = t286 + t310;
    out[0] = -t283;
    out[1] = t311;
    out[2] = t301;
    out[3] = t298;
    out[4] = -t233;
    out[5] = t191;
}

CGA_EXPORT int cga_tm5_700_tree_bias(const double *restrict q /* 6 */, const double *restrict v /* 6 */, double *restrict out /* 6 */)
{
    double c[6], s[6];
    for (int j = 0; j < 6; ++j) { c[j] = cos(q[j]); s[j] = sin(q[j]); }
    cga_tm5_700_tree_bias_body(c, s, v, out);
    return cga_not_finite(q, 6) || cga_not_finite(v, 6);
}

CGA_EXPORT int cga_tm5_700_tree_bias_batch(int64_t n, const double *restrict q /* 6 */, const double *restrict v /* 6 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_tm5_700_tree_bias(q + k * 6, v + k * 6, out + k * 6);
    return bad;
}
