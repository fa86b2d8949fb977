/* The kernel center_of_mass of panda. Made by `cga generate`; do not edit: the loader checks digests, and the next run overwrites it. */

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

/* Centre of mass (m) of all that moves, in the base frame (with a floating base: in the world, and the base's own mass counts). From cga_codegen.kernels.tree_kinematics.center_of_mass.
   173 mul, 130 add, 0 div, 0 sqrt. */
static inline void cga_panda_tree_center_of_mass_body(const T *restrict c, const T *restrict s, T *restrict out)
{
    const T t0 = K(0.0192614005) * c[0];
    const T t1 = K(0.010343993404000001) * s[0];
    const T t2 = t0 - t1;
    const T t3 = c[0] * c[1];
    const T t4 = K(0.002031994566) * t3;
    const T t5 = c[0] * s[1];
    const T t6 = K(0.018579714719999998) * t5;
    const T t7 = t4 - t6;
    const T t8 = s[0] * K(0.0022610063699999997);
    const T t9 = t7 + t8;
    const T t10 = t3 * c[2];
    const T t11 = s[0] * s[2];
    const T t12 = t10 - t11;
    const T t13 = K(0.088844724872) * t12;
    const T t14 = s[0] * c[2];
    const T t15 = t3 * s[2];
    const T t16 = t14 + t15;
    const T t17 = K(0.126729164208) * t16;
    const T t18 = t13 - t17;
    const T t19 = t5 * K(0.214708623208);
    const T t20 = t18 - t19;
    const T t21 = t5 * K(1.020238864);
    const T t22 = t20 + t21;
    const T t23 = t12 * K(0.0825);
    const T t24 = t5 * K(0.316);
    const T t25 = t23 + t24;
    const T t26 = K(3.587895) * t25;
    const T t27 = t12 * c[3];
    const T t28 = t5 * s[3];
    const T t29 = t27 + t28;
    const T t30 = K(0.19076837715) * t29;
    const T t31 = t5 * c[3];
    const T t32 = t12 * s[3];
    const T t33 = t31 - t32;
    const T t34 = K(0.374644408005) * t33;
    const T t35 = t30 - t34;
    const T t36 = t16 * K(0.09850206933);
    const T t37 = t35 - t36;
    const T t38 = t26 - t37;
    const T t39 = K(0.0825) * t29;
    const T t40 = t33 * K(0.384);
    const T t41 = t39 - t40;
    const T t42 = t25 - t41;
    const T t43 = K(1.225946) * t42;
    const T t44 = t29 * c[4];
    const T t45 = t16 * s[4];
    const T t46 = t44 - t45;
    const T t47 = K(0.014653732538) * t46;
    const T t48 = t16 * c[4];
    const T t49 = t29 * s[4];
    const T t50 = t48 + t49;
    const T t51 = K(0.05034347249) * t50;
    const T t52 = t47 + t51;
    const T t53 = t33 * K(0.047121686402);
    const T t54 = t52 + t53;
    const T t55 = t43 - t54;
    const T t56 = t42 * K(1.666555);
    const T t57 = t46 * c[5];
    const T t58 = t33 * s[5];
    const T t59 = t57 + t58;
    const T t60 = K(0.10024161669500001) * t59;
    const T t61 = t33 * c[5];
    const T t62 = t46 * s[5];
    const T t63 = t61 - t62;
    const T t64 = K(0.023526756935) * t63;
    const T t65 = t60 - t64;
    const T t66 = t50 * K(0.017527158935000002);
    const T t67 = t65 - t66;
    const T t68 = t56 + t67;
    const T t69 = t59 * K(0.088);
    const T t70 = t42 + t69;
    const T t71 = K(1.465522) * t70;
    const T t72 = t59 * c[6];
    const T t73 = t50 * s[6];
    const T t74 = t72 + t73;
    const T t75 = K(0.0025736053713382038) * t74;
    const T t76 = t50 * c[6];
    const T t77 = t59 * s[6];
    const T t78 = t76 - t77;
    const T t79 = K(0.0020344399586617982) * t78;
    const T t80 = t75 + t79;
    const T t81 = t63 * K(0.145315948634);
    const T t82 = t80 - t81;
    const T t83 = t71 + t82;
    const T t84 = t63 * K(0.1654);
    const T t85 = t70 - t84;
    const T t86 = t74 * K(0.7071067811865476);
    const T t87 = t78 * K(0.7071067811865475);
    const T t88 = t86 + t87;
    const T t89 = s[8] * t88;
    const T t90 = t85 - t89;
    const T t91 = K(0.015) * t90;
    const T t92 = t83 + t91;
    const T t93 = t88 * s[7];
    const T t94 = t85 + t93;
    const T t95 = K(0.015) * t94;
    const T t96 = t92 + t95;
    const T t97 = t68 + t96;
    const T t98 = t55 + t97;
    const T t99 = t38 + t98;
    const T t100 = t22 + t99;
    const T t101 = t9 - t100;
    const T t102 = t2 - t101;
    const T t103 = K(0.05944549715814855) * t102;
    const T t104 = K(0.0192614005) * s[0];
    const T t105 = c[0] * K(0.010343993404000001);
    const T t106 = t104 + t105;
    const T t107 = s[0] * c[1];
    const T t108 = K(0.002031994566) * t107;
    const T t109 = s[0] * s[1];
    const T t110 = K(0.018579714719999998) * t109;
    const T t111 = t108 - t110;
    const T t112 = c[0] * K(0.0022610063699999997);
    const T t113 = t111 - t112;
    const T t114 = c[2] * t107;
    const T t115 = c[0] * s[2];
    const T t116 = t114 + t115;
    const T t117 = K(0.088844724872) * t116;
    const T t118 = c[0] * c[2];
    const T t119 = s[2] * t107;
    const T t120 = t118 - t119;
    const T t121 = K(0.126729164208) * t120;
    const T t122 = t117 + t121;
    const T t123 = K(0.214708623208) * t109;
    const T t124 = t122 - t123;
    const T t125 = K(1.020238864) * t109;
    const T t126 = t124 + t125;
    const T t127 = K(0.0825) * t116;
    const T t128 = K(0.316) * t109;
    const T t129 = t127 + t128;
    const T t130 = K(3.587895) * t129;
    const T t131 = c[3] * t116;
    const T t132 = s[3] * t109;
    const T t133 = t131 + t132;
    const T t134 = K(0.19076837715) * t133;
    const T t135 = c[3] * t109;
    const T t136 = s[3] * t116;
    const T t137 = t135 - t136;
    const T t138 = K(0.374644408005) * t137;
    const T t139 = t134 - t138;
    const T t140 = K(0.09850206933) * t120;
    const T t141 = t139 + t140;
    const T t142 = t130 - t141;
    const T t143 = K(0.0825) * t133;
    const T t144 = K(0.384) * t137;
    const T t145 = t143 - t144;
    const T t146 = t129 - t145;
    const T t147 = K(1.225946) * t146;
    const T t148 = c[4] * t133;
    const T t149 = s[4] * t120;
    const T t150 = t148 + t149;
    const T t151 = K(0.014653732538) * t150;
    const T t152 = c[4] * t120;
    const T t153 = s[4] * t133;
    const T t154 = t152 - t153;
    const T t155 = K(0.05034347249) * t154;
    const T t156 = t151 - t155;
    const T t157 = K(0.047121686402) * t137;
    const T t158 = t156 + t157;
    const T t159 = t147 - t158;
    const T t160 = K(1.666555) * t146;
    const T t161 = c[5] * t150;
    const T t162 = s[5] * t137;
    const T t163 = t161 + t162;
    const T t164 = K(0.10024161669500001) * t163;
    const T t165 = c[5] * t137;
    const T t166 = s[5] * t150;
    const T t167 = t165 - t166;
    const T t168 = K(0.023526756935) * t167;
    const T t169 = t164 - t168;
    const T t170 = K(0.017527158935000002) * t154;
    const T t171 = t169 + t170;
    const T t172 = t160 + t171;
    const T t173 = K(0.088) * t163;
    const T t174 = t146 + t173;
    const T t175 = K(1.465522) * t174;
    const T t176 = c[6] * t163;
    const T t177 = s[6] * t154;
    const T t178 = t176 - t177;
    const T t179 = K(0.0025736053713382038) * t178;
    const T t180 = c[6] * t154;
    const T t181 = s[6] * t163;
    const T t182 = t180 + t181;
    const T t183 = K(0.0020344399586617982) * t182;
    const T t184 = t179 - t183;
    const T t185 = K(0.145315948634) * t167;
    const T t186 = t184 - t185;
    const T t187 = t175 + t186;
    const T t188 = K(0.1654) * t167;
    const T t189 = t174 - t188;
    const T t190 = K(0.7071067811865476) * t178;
    const T t191 = K(0.7071067811865475) * t182;
    const T t192 = t190 - t191;
    const T t193 = s[8] * t192;
    const T t194 = t189 - t193;
    const T t195 = K(0.015) * t194;
    const T t196 = t187 + t195;
    const T t197 = s[7] * t192;
    const T t198 = t189 + t197;
    const T t199 = K(0.015) * t198;
    const T t200 = t196 + t199;
    const T t201 = t172 + t200;
    const T t202 = t159 + t201;
    const T t203 = t142 + t202;
    const T t204 = t126 + t203;
    const T t205 = t113 - t204;
    const T t206 = t106 - t205;
    const T t207 = K(0.05944549715814855) * t206;
    const T t208 = K(0.002031994566) * s[1];
    const T t209 = c[1] * K(0.018579714719999998);
    const T t210 = t208 + t209;
    const T t211 = K(0.215426358) + t210;
    const T t212 = c[1] * K(0.316);
    const T t213 = K(0.333) + t212;
    const T t214 = K(3.228604) * t213;
    const T t215 = s[1] * s[2];
    const T t216 = K(0.126729164208) * t215;
    const T t217 = s[1] * c[2];
    const T t218 = K(0.088844724872) * t217;
    const T t219 = t216 - t218;
    const T t220 = c[1] * K(0.214708623208);
    const T t221 = t219 - t220;
    const T t222 = t214 + t221;
    const T t223 = K(0.0825) * t217;
    const T t224 = t213 - t223;
    const T t225 = K(3.587895) * t224;
    const T t226 = c[1] * s[3];
    const T t227 = c[3] * t217;
    const T t228 = t226 - t227;
    const T t229 = K(0.19076837715) * t228;
    const T t230 = c[1] * c[3];
    const T t231 = s[3] * t217;
    const T t232 = t230 + t231;
    const T t233 = K(0.374644408005) * t232;
    const T t234 = t229 - t233;
    const T t235 = K(0.09850206933) * t215;
    const T t236 = t234 + t235;
    const T t237 = t225 - t236;
    const T t238 = K(0.0825) * t228;
    const T t239 = K(0.384) * t232;
    const T t240 = t238 - t239;
    const T t241 = t224 - t240;
    const T t242 = K(1.225946) * t241;
    const T t243 = c[4] * t228;
    const T t244 = s[4] * t215;
    const T t245 = t243 + t244;
    const T t246 = K(0.014653732538) * t245;
    const T t247 = c[4] * t215;
    const T t248 = s[4] * t228;
    const T t249 = t247 - t248;
    const T t250 = K(0.05034347249) * t249;
    const T t251 = t246 - t250;
    const T t252 = K(0.047121686402) * t232;
    const T t253 = t251 + t252;
    const T t254 = t242 - t253;
    const T t255 = K(1.666555) * t241;
    const T t256 = c[5] * t245;
    const T t257 = s[5] * t232;
    const T t258 = t256 + t257;
    const T t259 = K(0.10024161669500001) * t258;
    const T t260 = c[5] * t232;
    const T t261 = s[5] * t245;
    const T t262 = t260 - t261;
    const T t263 = K(0.023526756935) * t262;
    const T t264 = t259 - t263;
    const T t265 = K(0.017527158935000002) * t249;
    const T t266 = t264 + t265;
    const T t267 = t255 + t266;
    const T t268 = K(0.088) * t258;
    const T t269 = t241 + t268;
    const T t270 = K(1.465522) * t269;
    const T t271 = c[6] * t258;
    const T t272 = s[6] * t249;
    const T t273 = t271 - t272;
    const T t274 = K(0.0025736053713382038) * t273;
    const T t275 = c[6] * t249;
    const T t276 = s[6] * t258;
    const T t277 = t275 + t276;
    const T t278 = K(0.0020344399586617982) * t277;
    const T t279 = t274 - t278;
    const T t280 = K(0.145315948634) * t262;
    const T t281 = t279 - t280;
    const T t282 = t270 + t281;
    const T t283 = K(0.1654) * t262;
    const T t284 = t269 - t283;
    const T t285 = K(0.7071067811865476) * t273;
    const T t286 = K(0.7071067811865475) * t277;
    const T t287 = t285 - t286;
    const T t288 = s[8] * t287;
    const T t289 = t284 - t288;
    const T t290 = K(0.015) * t289;
    const T t291 = t282 + t290;
    const T t292 = s[7] * t287;
    const T t293 = t284 + t292;
    const T t294 = K(0.015) * t293;
    const T t295 = t291 + t294;
    const T t296 = t267 + t295;
    const T t297 = t254 + t296;
    const T t298 = t237 + t297;
    const T t299 = t222 + t298;
    const T t300 = t211 + t299;
    const T t301 = K(1.4185337999200003) + t300;
    const T t302 = K(0.05944549715814855) * t301;
    out[0] = t103;
    out[1] = t207;
    out[2] = t302;
}

CGA_EXPORT int cga_panda_tree_center_of_mass(const double *restrict q /* 8 */, double *restrict out /* 3 */)
{
    double c[9], s[9];
    c[0] = cos(q[0]); s[0] = sin(q[0]);
    c[1] = cos(q[1]); s[1] = sin(q[1]);
    c[2] = cos(q[2]); s[2] = sin(q[2]);
    c[3] = cos(q[3]); s[3] = sin(q[3]);
    c[4] = cos(q[4]); s[4] = sin(q[4]);
    c[5] = cos(q[5]); s[5] = sin(q[5]);
    c[6] = cos(q[6]); s[6] = sin(q[6]);
    c[7] = 1.0; s[7] = q[7];
    c[8] = 1.0; s[8] = q[7];
    cga_panda_tree_center_of_mass_body(c, s, out);
    return cga_not_finite(q, 8);
}

CGA_EXPORT int cga_panda_tree_center_of_mass_batch(int64_t n, const double *restrict q /* 8 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_panda_tree_center_of_mass(q + k * 8, out + k * 3);
    return bad;
}
