/* The kernel gravity of panda. Made by `cga generate`; do not edit: the loader checks digests, and the next run overwrites it. */

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

/* g(q): inverse dynamics at rest. From cga_codegen.kernels.dynamics.gravity.
   143 mul, 103 add, 0 div, 0 sqrt. */
static inline void cga_panda_tree_gravity_body(const T *restrict c, const T *restrict s, T *restrict out)
{
    const T t0 = s[1] * K(9.81);
    const T t1 = s[2] * t0;
    const T t2 = K(0.214708623208) * t1;
    const T t3 = K(1.24321310088048) * c[1];
    const T t4 = t2 + t3;
    const T t5 = t1 * K(0.374644408005);
    const T t6 = K(9.81) * c[1];
    const T t7 = c[3] * t6;
    const T t8 = c[2] * t0;
    const T t9 = s[3] * t8;
    const T t10 = t7 + t9;
    const T t11 = K(0.09850206933) * t10;
    const T t12 = t5 + t11;
    const T t13 = t1 * c[4];
    const T t14 = c[3] * t8;
    const T t15 = t6 * s[3];
    const T t16 = t14 - t15;
    const T t17 = s[4] * t16;
    const T t18 = t13 + t17;
    const T t19 = K(0.047121686402) * t18;
    const T t20 = t10 * K(0.05034347249);
    const T t21 = t19 + t20;
    const T t22 = t18 * K(0.023526756935);
    const T t23 = t10 * c[5];
    const T t24 = c[4] * t16;
    const T t25 = t1 * s[4];
    const T t26 = t24 - t25;
    const T t27 = s[5] * t26;
    const T t28 = t23 + t27;
    const T t29 = K(0.017527158935000002) * t28;
    const T t30 = t22 + t29;
    const T t31 = t28 * K(0.0020344399586617982);
    const T t32 = t18 * c[6];
    const T t33 = c[5] * t26;
    const T t34 = t10 * s[5];
    const T t35 = t33 - t34;
    const T t36 = s[6] * t35;
    const T t37 = t32 - t36;
    const T t38 = K(0.145315948634) * t37;
    const T t39 = t31 - t38;
    const T t40 = K(0.7071067811865475) * s[8];
    const T t41 = t28 * K(0.015);
    const T t42 = t40 * t41;
    const T t43 = c[6] * t35;
    const T t44 = t18 * s[6];
    const T t45 = t43 + t44;
    const T t46 = K(0.7071067811865475) * t45;
    const T t47 = t37 * K(0.7071067811865476);
    const T t48 = t46 - t47;
    const T t49 = K(0.010606601717798213) * t48;
    const T t50 = t45 * K(0.7071067811865476);
    const T t51 = t37 * K(0.7071067811865475);
    const T t52 = t50 + t51;
    const T t53 = K(0.010606601717798212) * t52;
    const T t54 = t49 - t53;
    const T t55 = K(0.1654) * t54;
    const T t56 = t42 - t55;
    const T t57 = t39 - t56;
    const T t58 = K(0.7071067811865475) * s[7];
    const T t59 = t41 * t58;
    const T t60 = t55 + t59;
    const T t61 = t57 + t60;
    const T t62 = c[6] * t61;
    const T t63 = K(0.145315948634) * t45;
    const T t64 = t28 * K(0.0025736053713382038);
    const T t65 = t63 - t64;
    const T t66 = t48 * K(0.010606601717798212);
    const T t67 = K(0.010606601717798213) * t52;
    const T t68 = t66 + t67;
    const T t69 = K(0.1654) * t68;
    const T t70 = s[8] * K(0.7071067811865476);
    const T t71 = t41 * t70;
    const T t72 = t69 + t71;
    const T t73 = t65 + t72;
    const T t74 = K(0.7071067811865476) * s[7];
    const T t75 = t41 * t74;
    const T t76 = t69 - t75;
    const T t77 = t73 + t76;
    const T t78 = s[6] * t77;
    const T t79 = t62 - t78;
    const T t80 = t30 - t79;
    const T t81 = c[5] * t80;
    const T t82 = K(0.017527158935000002) * t35;
    const T t83 = t18 * K(0.10024161669500001);
    const T t84 = t82 + t83;
    const T t85 = t37 * K(0.0025736053713382038);
    const T t86 = K(0.0020344399586617982) * t45;
    const T t87 = t85 - t86;
    const T t88 = t54 * t70;
    const T t89 = t40 * t68;
    const T t90 = t88 + t89;
    const T t91 = t87 + t90;
    const T t92 = t54 * t74;
    const T t93 = t58 * t68;
    const T t94 = t92 + t93;
    const T t95 = t91 - t94;
    const T t96 = t45 * K(1.465522);
    const T t97 = t68 + t96;
    const T t98 = t68 + t97;
    const T t99 = s[6] * t98;
    const T t100 = t37 * K(1.465522);
    const T t101 = t54 - t100;
    const T t102 = t54 + t101;
    const T t103 = c[6] * t102;
    const T t104 = t99 - t103;
    const T t105 = K(0.088) * t104;
    const T t106 = t95 + t105;
    const T t107 = t84 + t106;
    const T t108 = s[5] * t107;
    const T t109 = t81 - t108;
    const T t110 = t21 + t109;
    const T t111 = c[4] * t110;
    const T t112 = K(0.047121686402) * t26;
    const T t113 = t10 * K(0.014653732538);
    const T t114 = t112 + t113;
    const T t115 = s[6] * t61;
    const T t116 = c[6] * t77;
    const T t117 = t115 + t116;
    const T t118 = t28 * K(1.465522);
    const T t119 = t41 + t118;
    const T t120 = t41 + t119;
    const T t121 = K(0.088) * t120;
    const T t122 = t117 - t121;
    const T t123 = t28 * K(0.10024161669500001);
    const T t124 = K(0.023526756935) * t35;
    const T t125 = t123 - t124;
    const T t126 = t122 - t125;
    const T t127 = t114 + t126;
    const T t128 = s[4] * t127;
    const T t129 = t111 - t128;
    const T t130 = t26 * K(1.225946);
    const T t131 = t35 * K(1.666555);
    const T t132 = c[6] * t98;
    const T t133 = s[6] * t102;
    const T t134 = t132 + t133;
    const T t135 = t131 + t134;
    const T t136 = c[5] * t135;
    const T t137 = t28 * K(1.666555);
    const T t138 = t120 + t137;
    const T t139 = s[5] * t138;
    const T t140 = t136 + t139;
    const T t141 = t130 + t140;
    const T t142 = s[4] * t141;
    const T t143 = t18 * K(1.225946);
    const T t144 = t18 * K(1.666555);
    const T t145 = t104 + t144;
    const T t146 = t143 + t145;
    const T t147 = c[4] * t146;
    const T t148 = t142 - t147;
    const T t149 = K(0.384) * t148;
    const T t150 = t129 + t149;
    const T t151 = t12 - t150;
    const T t152 = c[3] * t151;
    const T t153 = K(0.09850206933) * t16;
    const T t154 = t1 * K(0.19076837715);
    const T t155 = t153 + t154;
    const T t156 = s[5] * t80;
    const T t157 = c[5] * t107;
    const T t158 = t156 + t157;
    const T t159 = t18 * K(0.014653732538);
    const T t160 = K(0.05034347249) * t26;
    const T t161 = t159 - t160;
    const T t162 = t158 - t161;
    const T t163 = t148 * K(0.0825);
    const T t164 = t162 + t163;
    const T t165 = t155 - t164;
    const T t166 = s[3] * t165;
    const T t167 = t152 - t166;
    const T t168 = t4 - t167;
    const T t169 = c[2] * t168;
    const T t170 = K(0.214708623208) * t8;
    const T t171 = c[1] * K(0.87156675099432);
    const T t172 = t170 - t171;
    const T t173 = s[5] * t135;
    const T t174 = c[5] * t138;
    const T t175 = t173 - t174;
    const T t176 = t10 * K(1.225946);
    const T t177 = t175 - t176;
    const T t178 = K(0.0825) * t177;
    const T t179 = c[4] * t141;
    const T t180 = s[4] * t146;
    const T t181 = t179 + t180;
    const T t182 = K(0.384) * t181;
    const T t183 = t178 + t182;
    const T t184 = s[4] * t110;
    const T t185 = c[4] * t127;
    const T t186 = t184 + t185;
    const T t187 = t183 - t186;
    const T t188 = t10 * K(0.19076837715);
    const T t189 = K(0.374644408005) * t16;
    const T t190 = t188 - t189;
    const T t191 = t187 - t190;
    const T t192 = t16 * K(3.587895);
    const T t193 = t181 + t192;
    const T t194 = s[3] * t193;
    const T t195 = t10 * K(3.587895);
    const T t196 = t177 - t195;
    const T t197 = c[3] * t196;
    const T t198 = t194 + t197;
    const T t199 = K(0.0825) * t198;
    const T t200 = t191 - t199;
    const T t201 = t172 - t200;
    const T t202 = s[2] * t201;
    const T t203 = t169 - t202;
    const T t204 = t8 * K(3.228604);
    const T t205 = c[3] * t193;
    const T t206 = s[3] * t196;
    const T t207 = t205 - t206;
    const T t208 = t204 + t207;
    const T t209 = s[2] * t208;
    const T t210 = t1 * K(3.228604);
    const T t211 = t1 * K(3.587895);
    const T t212 = t148 - t211;
    const T t213 = t210 - t212;
    const T t214 = c[2] * t213;
    const T t215 = t209 - t214;
    const T t216 = K(0.316) * t215;
    const T t217 = t203 + t216;
    const T t218 = c[1] * K(0.0221804724897);
    const T t219 = t217 + t218;
    const T t220 = s[1] * t219;
    const T t221 = s[1] * K(0.0221804724897);
    const T t222 = s[3] * t151;
    const T t223 = c[3] * t165;
    const T t224 = t222 + t223;
    const T t225 = K(0.0825) * t212;
    const T t226 = t224 + t225;
    const T t227 = t1 * K(0.088844724872);
    const T t228 = t8 * K(0.126729164208);
    const T t229 = t227 + t228;
    const T t230 = t226 - t229;
    const T t231 = t221 - t230;
    const T t232 = c[1] * t231;
    const T t233 = t220 - t232;
    const T t234 = c[1] * K(0.01993386669246);
    const T t235 = s[1] * K(0.18226700140319999);
    const T t236 = t234 - t235;
    const T t237 = s[2] * t168;
    const T t238 = c[2] * t201;
    const T t239 = t237 + t238;
    const T t240 = c[2] * t208;
    const T t241 = s[2] * t213;
    const T t242 = t240 + t241;
    const T t243 = K(0.316) * t242;
    const T t244 = t239 - t243;
    const T t245 = t236 + t244;
    out[0] = -t233;
    out[1] = t245;
    out[2] = -t230;
    out[3] = t191;
    out[4] = t162;
    out[5] = -t126;
    out[6] = -t95;
    out[7] = K(0.0);
}

CGA_EXPORT int cga_panda_tree_gravity(const double *restrict q /* 8 */, double *restrict out /* 8 */)
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
    cga_panda_tree_gravity_body(c, s, out);
    return cga_not_finite(q, 8);
}

CGA_EXPORT int cga_panda_tree_gravity_batch(int64_t n, const double *restrict q /* 8 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_panda_tree_gravity(q + k * 8, out + k * 8);
    return bad;
}
