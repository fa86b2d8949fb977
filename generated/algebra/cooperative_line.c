/* The cooperative line from its points. Made by `cga generate`; do not edit: the loader checks digests, and the next run overwrites it. */

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

/* The primitive X = P1 ^ ... ^ Pk, of line and plane ^ ei, P = e0 + x + x^2/2 ei: its size is the weight (paper A, eq. 14). From cga_codegen.kernels.primitives.primitive.
   6 mul, 6 add, 0 div, 0 sqrt. */
static inline void cga_cooperative_line_primitive_body(const T *restrict points, T *restrict out)
{
    const T t0 = points[3] - points[0];
    const T t1 = points[4] - points[1];
    const T t2 = points[0] * points[4];
    const T t3 = points[3] * points[1];
    const T t4 = t2 - t3;
    const T t5 = points[5] - points[2];
    const T t6 = points[0] * points[5];
    const T t7 = points[3] * points[2];
    const T t8 = t6 - t7;
    const T t9 = points[1] * points[5];
    const T t10 = points[4] * points[2];
    const T t11 = t9 - t10;
    out[0] = t0;
    out[1] = t1;
    out[2] = t4;
    out[3] = t5;
    out[4] = t8;
    out[5] = t11;
}

CGA_EXPORT int cga_cooperative_line_primitive(const double *restrict points /* 6 */, double *restrict out /* 6 */)
{
    cga_cooperative_line_primitive_body(points, out);
    return cga_not_finite(points, 6);
}

CGA_EXPORT int cga_cooperative_line_primitive_batch(int64_t n, const double *restrict points /* 6 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_line_primitive(points + k * 6, out + k * 6);
    return bad;
}

/* Derivative of the primitive by the points: one factor after the other is replaced by its derivative (paper A, eqs. 15-17). From cga_codegen.kernels.primitives.primitive_jacobian.
   0 mul, 0 add, 0 div, 0 sqrt. */
static inline void cga_cooperative_line_primitive_jacobian_body(const T *restrict points, T *restrict out)
{
    out[0] = -K(1.0);
    out[1] = K(0.0);
    out[2] = K(0.0);
    out[3] = K(1.0);
    out[4] = K(0.0);
    out[5] = K(0.0);
    out[6] = K(0.0);
    out[7] = -K(1.0);
    out[8] = K(0.0);
    out[9] = K(0.0);
    out[10] = K(1.0);
    out[11] = K(0.0);
    out[12] = points[4];
    out[13] = -points[3];
    out[14] = K(0.0);
    out[15] = -points[1];
    out[16] = points[0];
    out[17] = K(0.0);
    out[18] = K(0.0);
    out[19] = K(0.0);
    out[20] = -K(1.0);
    out[21] = K(0.0);
    out[22] = K(0.0);
    out[23] = K(1.0);
    out[24] = points[5];
    out[25] = K(0.0);
    out[26] = -points[3];
    out[27] = -points[2];
    out[28] = K(0.0);
    out[29] = points[0];
    out[30] = K(0.0);
    out[31] = points[5];
    out[32] = -points[4];
    out[33] = K(0.0);
    out[34] = -points[2];
    out[35] = points[1];
}

CGA_EXPORT int cga_cooperative_line_primitive_jacobian(const double *restrict points /* 6 */, double *restrict out /* 36 */)
{
    cga_cooperative_line_primitive_jacobian_body(points, out);
    return cga_not_finite(points, 6);
}

CGA_EXPORT int cga_cooperative_line_primitive_jacobian_batch(int64_t n, const double *restrict points /* 6 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_line_primitive_jacobian(points + k * 6, out + k * 36);
    return bad;
}

/* V with V X_u ~V = X over its weight (paper A, eq. 28). From cga_codegen.kernels.similarity.similarity.
   39 mul, 25 add, 6 div, 2 sqrt. */
static inline void cga_cooperative_line_similarity_body(const T *restrict points, const T *restrict chart, T *restrict out)
{
    const T t0 = K(1.0) + chart[0];
    const T t1 = K(0.5) * t0;
    const T t2 = points[4] - points[1];
    const T t3 = points[3] - points[0];
    const T t4 = t3 * t3;
    const T t5 = t2 * t2;
    const T t6 = t4 + t5;
    const T t7 = points[5] - points[2];
    const T t8 = t7 * t7;
    const T t9 = t6 + t8;
    const T t10 = ROOT(t9);
    const T t11 = t2 / t10;
    const T t12 = chart[0] + t11;
    const T t13 = t3 / t10;
    const T t14 = t13 * t13;
    const T t15 = t12 * t12;
    const T t16 = t14 + t15;
    const T t17 = t7 / t10;
    const T t18 = t17 * t17;
    const T t19 = t16 + t18;
    const T t20 = ROOT(t19);
    const T t21 = t12 / t20;
    const T t22 = chart[0] * t21;
    const T t23 = t1 * t22;
    const T t24 = K(1.0) - chart[0];
    const T t25 = K(0.5) * t24;
    const T t26 = t17 / t20;
    const T t27 = chart[0] * t26;
    const T t28 = t25 * t27;
    const T t29 = t23 - t28;
    const T t30 = t13 / t20;
    const T t31 = chart[0] * t30;
    const T t32 = t1 * t31;
    const T t33 = t25 * t31;
    const T t34 = t1 * t27;
    const T t35 = t22 * t25;
    const T t36 = t34 + t35;
    const T t37 = K(0.5) * t29;
    const T t38 = points[0] * t13;
    const T t39 = points[1] * t11;
    const T t40 = t38 + t39;
    const T t41 = points[2] * t17;
    const T t42 = t40 + t41;
    const T t43 = t13 * t42;
    const T t44 = points[0] - t43;
    const T t45 = t37 * t44;
    const T t46 = K(0.5) * t32;
    const T t47 = t11 * t42;
    const T t48 = points[1] - t47;
    const T t49 = t46 * t48;
    const T t50 = t45 - t49;
    const T t51 = K(0.5) * t33;
    const T t52 = t17 * t42;
    const T t53 = points[2] - t52;
    const T t54 = t51 * t53;
    const T t55 = t50 + t54;
    const T t56 = t37 * t48;
    const T t57 = t44 * t46;
    const T t58 = t56 + t57;
    const T t59 = K(0.5) * t36;
    const T t60 = t53 * t59;
    const T t61 = t58 + t60;
    const T t62 = t37 * t53;
    const T t63 = t44 * t51;
    const T t64 = t62 - t63;
    const T t65 = t48 * t59;
    const T t66 = t64 - t65;
    const T t67 = t46 * t53;
    const T t68 = t48 * t51;
    const T t69 = t67 + t68;
    const T t70 = t44 * t59;
    const T t71 = t69 - t70;
    out[0] = t29;
    out[1] = t32;
    out[2] = -t33;
    out[3] = -t36;
    out[4] = K(0.0);
    out[5] = -t55;
    out[6] = -t61;
    out[7] = K(0.0);
    out[8] = -t66;
    out[9] = K(0.0);
    out[10] = K(0.0);
    out[11] = -t71;
}

CGA_EXPORT int cga_cooperative_line_similarity(const double *restrict points /* 6 */, const double *restrict chart /* 1 */, double *restrict out /* 12 */)
{
    cga_cooperative_line_similarity_body(points, chart, out);
    return cga_not_finite(points, 6) || cga_not_finite(chart, 1);
}

CGA_EXPORT int cga_cooperative_line_similarity_batch(int64_t n, const double *restrict points /* 6 */, const double *restrict chart /* 1 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_line_similarity(points + k * 6, chart + k * 1, out + k * 12);
    return bad;
}

/* The factors of V: rotor 1 e12 e13 e23, centre (m), radius (m; 1 of flat ones). From cga_codegen.kernels.similarity.parts.
   23 mul, 17 add, 6 div, 2 sqrt. */
static inline void cga_cooperative_line_parts_body(const T *restrict points, const T *restrict chart, T *restrict out)
{
    const T t0 = K(1.0) + chart[0];
    const T t1 = K(0.5) * t0;
    const T t2 = points[4] - points[1];
    const T t3 = points[3] - points[0];
    const T t4 = t3 * t3;
    const T t5 = t2 * t2;
    const T t6 = t4 + t5;
    const T t7 = points[5] - points[2];
    const T t8 = t7 * t7;
    const T t9 = t6 + t8;
    const T t10 = ROOT(t9);
    const T t11 = t2 / t10;
    const T t12 = chart[0] + t11;
    const T t13 = t3 / t10;
    const T t14 = t13 * t13;
    const T t15 = t12 * t12;
    const T t16 = t14 + t15;
    const T t17 = t7 / t10;
    const T t18 = t17 * t17;
    const T t19 = t16 + t18;
    const T t20 = ROOT(t19);
    const T t21 = t12 / t20;
    const T t22 = chart[0] * t21;
    const T t23 = t1 * t22;
    const T t24 = K(1.0) - chart[0];
    const T t25 = K(0.5) * t24;
    const T t26 = t17 / t20;
    const T t27 = chart[0] * t26;
    const T t28 = t25 * t27;
    const T t29 = t23 - t28;
    const T t30 = t13 / t20;
    const T t31 = chart[0] * t30;
    const T t32 = t1 * t31;
    const T t33 = t25 * t31;
    const T t34 = t1 * t27;
    const T t35 = t22 * t25;
    const T t36 = t34 + t35;
    const T t37 = points[0] * t13;
    const T t38 = points[1] * t11;
    const T t39 = t37 + t38;
    const T t40 = points[2] * t17;
    const T t41 = t39 + t40;
    const T t42 = t13 * t41;
    const T t43 = points[0] - t42;
    const T t44 = t11 * t41;
    const T t45 = points[1] - t44;
    const T t46 = t17 * t41;
    const T t47 = points[2] - t46;
    out[0] = t29;
    out[1] = t32;
    out[2] = -t33;
    out[3] = -t36;
    out[4] = t43;
    out[5] = t45;
    out[6] = t47;
    out[7] = K(1.0);
}

CGA_EXPORT int cga_cooperative_line_parts(const double *restrict points /* 6 */, const double *restrict chart /* 1 */, double *restrict out /* 8 */)
{
    cga_cooperative_line_parts_body(points, chart, out);
    return cga_not_finite(points, 6) || cga_not_finite(chart, 1);
}

CGA_EXPORT int cga_cooperative_line_parts_batch(int64_t n, const double *restrict points /* 6 */, const double *restrict chart /* 1 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_line_parts(points + k * 6, chart + k * 1, out + k * 8);
    return bad;
}

/* dV = -1/2 V J_G by the points (paper A, eq. 29). From cga_codegen.kernels.similarity.analytic_jacobian.
   233 mul, 196 add, 14 div, 2 sqrt. */
static inline void cga_cooperative_line_analytic_jacobian_body(const T *restrict points, const T *restrict chart, T *restrict out)
{
    const T t0 = K(1.0) - chart[0];
    const T t1 = K(0.5) * t0;
    const T t2 = points[3] - points[0];
    const T t3 = t2 * t2;
    const T t4 = points[4] - points[1];
    const T t5 = t4 * t4;
    const T t6 = t3 + t5;
    const T t7 = points[5] - points[2];
    const T t8 = t7 * t7;
    const T t9 = t6 + t8;
    const T t10 = ROOT(t9);
    const T t11 = t2 / t10;
    const T t12 = t11 * t11;
    const T t13 = t4 / t10;
    const T t14 = chart[0] + t13;
    const T t15 = t14 * t14;
    const T t16 = t12 + t15;
    const T t17 = t7 / t10;
    const T t18 = t17 * t17;
    const T t19 = t16 + t18;
    const T t20 = ROOT(t19);
    const T t21 = t11 / t20;
    const T t22 = chart[0] * t21;
    const T t23 = t1 * t22;
    const T t24 = K(0.5) * t23;
    const T t25 = K(1.0) + chart[0];
    const T t26 = K(0.5) * t25;
    const T t27 = t22 * t26;
    const T t28 = t23 * t27;
    const T t29 = t14 / t20;
    const T t30 = chart[0] * t29;
    const T t31 = t26 * t30;
    const T t32 = t17 / t20;
    const T t33 = chart[0] * t32;
    const T t34 = t1 * t33;
    const T t35 = t31 - t34;
    const T t36 = t26 * t33;
    const T t37 = t1 * t30;
    const T t38 = t36 + t37;
    const T t39 = t35 * t38;
    const T t40 = t28 - t39;
    const T t41 = t40 * K(2.0);
    const T t42 = chart[0] * t41;
    const T t43 = K(2.0) * t42;
    const T t44 = t43 / t19;
    const T t45 = t23 * t23;
    const T t46 = t27 * t27;
    const T t47 = t45 + t46;
    const T t48 = K(2.0) * t47;
    const T t49 = K(1.0) - t48;
    const T t50 = t27 * t35;
    const T t51 = t23 * t38;
    const T t52 = t50 - t51;
    const T t53 = K(2.0) * t52;
    const T t54 = t2 * t53;
    const T t55 = t38 * t38;
    const T t56 = t46 + t55;
    const T t57 = K(2.0) * t56;
    const T t58 = K(1.0) - t57;
    const T t59 = t4 * t58;
    const T t60 = t54 + t59;
    const T t61 = t28 + t39;
    const T t62 = K(2.0) * t61;
    const T t63 = t7 * t62;
    const T t64 = t60 + t63;
    const T t65 = t49 / t64;
    const T t66 = t44 * t65;
    const T t67 = t50 + t51;
    const T t68 = K(2.0) * t67;
    const T t69 = chart[0] * t68;
    const T t70 = K(2.0) * t69;
    const T t71 = t70 / t19;
    const T t72 = t27 * t38;
    const T t73 = t23 * t35;
    const T t74 = t72 + t73;
    const T t75 = K(2.0) * t74;
    const T t76 = t75 / t64;
    const T t77 = t71 * t76;
    const T t78 = t66 - t77;
    const T t79 = t24 * t78;
    const T t80 = K(0.5) * t27;
    const T t81 = t65 * t80;
    const T t82 = t79 - t81;
    const T t83 = K(0.5) * t38;
    const T t84 = t76 * t83;
    const T t85 = t82 + t84;
    const T t86 = t68 / t64;
    const T t87 = t44 * t86;
    const T t88 = t41 / t64;
    const T t89 = t71 * t88;
    const T t90 = t87 - t89;
    const T t91 = t24 * t90;
    const T t92 = t80 * t86;
    const T t93 = t91 - t92;
    const T t94 = t83 * t88;
    const T t95 = t93 + t94;
    const T t96 = t72 - t73;
    const T t97 = K(2.0) * t96;
    const T t98 = t97 / t64;
    const T t99 = t44 * t98;
    const T t100 = t45 + t55;
    const T t101 = K(2.0) * t100;
    const T t102 = K(1.0) - t101;
    const T t103 = t102 / t64;
    const T t104 = t71 * t103;
    const T t105 = t99 - t104;
    const T t106 = t24 * t105;
    const T t107 = t80 * t98;
    const T t108 = t106 - t107;
    const T t109 = t83 * t103;
    const T t110 = t108 + t109;
    const T t111 = K(0.5) * t35;
    const T t112 = t65 * t111;
    const T t113 = t24 * t76;
    const T t114 = t112 + t113;
    const T t115 = t78 * t83;
    const T t116 = t114 - t115;
    const T t117 = t86 * t111;
    const T t118 = t24 * t88;
    const T t119 = t117 + t118;
    const T t120 = t83 * t90;
    const T t121 = t119 - t120;
    const T t122 = t98 * t111;
    const T t123 = t24 * t103;
    const T t124 = t122 + t123;
    const T t125 = t83 * t105;
    const T t126 = t124 - t125;
    const T t127 = t78 * t111;
    const T t128 = t76 * t80;
    const T t129 = t127 + t128;
    const T t130 = t65 * t83;
    const T t131 = t129 + t130;
    const T t132 = t90 * t111;
    const T t133 = t80 * t88;
    const T t134 = t132 + t133;
    const T t135 = t83 * t86;
    const T t136 = t134 + t135;
    const T t137 = t105 * t111;
    const T t138 = t80 * t103;
    const T t139 = t137 + t138;
    const T t140 = t83 * t98;
    const T t141 = t139 + t140;
    const T t142 = t76 * t111;
    const T t143 = t78 * t80;
    const T t144 = t142 - t143;
    const T t145 = t24 * t65;
    const T t146 = t144 - t145;
    const T t147 = t88 * t111;
    const T t148 = t80 * t90;
    const T t149 = t147 - t148;
    const T t150 = t24 * t86;
    const T t151 = t149 - t150;
    const T t152 = t103 * t111;
    const T t153 = t80 * t105;
    const T t154 = t152 - t153;
    const T t155 = t24 * t98;
    const T t156 = t154 - t155;
    const T t157 = points[0] * t53;
    const T t158 = points[1] * t58;
    const T t159 = t157 + t158;
    const T t160 = points[2] * t62;
    const T t161 = t159 + t160;
    const T t162 = t64 + t161;
    const T t163 = t65 * t162;
    const T t164 = t111 * t163;
    const T t165 = points[0] * t11;
    const T t166 = points[1] * t13;
    const T t167 = t165 + t166;
    const T t168 = points[2] * t17;
    const T t169 = t167 + t168;
    const T t170 = t11 * t169;
    const T t171 = points[0] - t170;
    const T t172 = t49 * t171;
    const T t173 = t13 * t169;
    const T t174 = points[1] - t173;
    const T t175 = t68 * t174;
    const T t176 = t172 - t175;
    const T t177 = t17 * t169;
    const T t178 = points[2] - t177;
    const T t179 = t97 * t178;
    const T t180 = t176 - t179;
    const T t181 = t65 * t180;
    const T t182 = t75 * t171;
    const T t183 = t41 * t174;
    const T t184 = t182 - t183;
    const T t185 = t102 * t178;
    const T t186 = t184 - t185;
    const T t187 = t76 * t186;
    const T t188 = t181 + t187;
    const T t189 = t80 * t188;
    const T t190 = t164 + t189;
    const T t191 = t76 * t162;
    const T t192 = t24 * t191;
    const T t193 = t190 + t192;
    const T t194 = t111 * t174;
    const T t195 = t80 * t171;
    const T t196 = t194 + t195;
    const T t197 = t83 * t178;
    const T t198 = t196 + t197;
    const T t199 = K(0.5) * t198;
    const T t200 = t65 * t199;
    const T t201 = t193 + t200;
    const T t202 = t111 * t178;
    const T t203 = t24 * t171;
    const T t204 = t202 - t203;
    const T t205 = t83 * t174;
    const T t206 = t204 - t205;
    const T t207 = K(0.5) * t206;
    const T t208 = t78 * t207;
    const T t209 = t201 + t208;
    const T t210 = t80 * t178;
    const T t211 = t24 * t174;
    const T t212 = t210 + t211;
    const T t213 = t83 * t171;
    const T t214 = t212 - t213;
    const T t215 = K(0.5) * t214;
    const T t216 = t76 * t215;
    const T t217 = t209 + t216;
    const T t218 = t86 * t162;
    const T t219 = t111 * t218;
    const T t220 = t86 * t180;
    const T t221 = t88 * t186;
    const T t222 = t220 + t221;
    const T t223 = t80 * t222;
    const T t224 = t219 + t223;
    const T t225 = t88 * t162;
    const T t226 = t24 * t225;
    const T t227 = t224 + t226;
    const T t228 = t86 * t199;
    const T t229 = t227 + t228;
    const T t230 = t90 * t207;
    const T t231 = t229 + t230;
    const T t232 = t88 * t215;
    const T t233 = t231 + t232;
    const T t234 = t98 * t162;
    const T t235 = t111 * t234;
    const T t236 = t98 * t180;
    const T t237 = t103 * t186;
    const T t238 = t236 + t237;
    const T t239 = t80 * t238;
    const T t240 = t235 + t239;
    const T t241 = t103 * t162;
    const T t242 = t24 * t241;
    const T t243 = t240 + t242;
    const T t244 = t98 * t199;
    const T t245 = t243 + t244;
    const T t246 = t105 * t207;
    const T t247 = t245 + t246;
    const T t248 = t103 * t215;
    const T t249 = t247 + t248;
    const T t250 = t76 * t161;
    const T t251 = t24 * t250;
    const T t252 = t65 * t161;
    const T t253 = t111 * t252;
    const T t254 = t189 + t253;
    const T t255 = t251 + t254;
    const T t256 = t200 + t255;
    const T t257 = t208 + t256;
    const T t258 = t216 + t257;
    const T t259 = t88 * t161;
    const T t260 = t24 * t259;
    const T t261 = t86 * t161;
    const T t262 = t111 * t261;
    const T t263 = t223 + t262;
    const T t264 = t260 + t263;
    const T t265 = t228 + t264;
    const T t266 = t230 + t265;
    const T t267 = t232 + t266;
    const T t268 = t103 * t161;
    const T t269 = t24 * t268;
    const T t270 = t98 * t161;
    const T t271 = t111 * t270;
    const T t272 = t239 + t271;
    const T t273 = t269 + t272;
    const T t274 = t244 + t273;
    const T t275 = t246 + t274;
    const T t276 = t248 + t275;
    const T t277 = t111 * t188;
    const T t278 = t80 * t163;
    const T t279 = t277 - t278;
    const T t280 = t83 * t191;
    const T t281 = t279 + t280;
    const T t282 = t111 * t171;
    const T t283 = t80 * t174;
    const T t284 = t282 - t283;
    const T t285 = t24 * t178;
    const T t286 = t284 + t285;
    const T t287 = K(0.5) * t286;
    const T t288 = t65 * t287;
    const T t289 = t281 - t288;
    const T t290 = t76 * t207;
    const T t291 = t289 + t290;
    const T t292 = t78 * t215;
    const T t293 = t291 - t292;
    const T t294 = t111 * t222;
    const T t295 = t80 * t218;
    const T t296 = t294 - t295;
    const T t297 = t83 * t225;
    const T t298 = t296 + t297;
    const T t299 = t86 * t287;
    const T t300 = t298 - t299;
    const T t301 = t88 * t207;
    const T t302 = t300 + t301;
    const T t303 = t90 * t215;
    const T t304 = t302 - t303;
    const T t305 = t111 * t238;
    const T t306 = t80 * t234;
    const T t307 = t305 - t306;
    const T t308 = t83 * t241;
    const T t309 = t307 + t308;
    const T t310 = t98 * t287;
    const T t311 = t309 - t310;
    const T t312 = t103 * t207;
    const T t313 = t311 + t312;
    const T t314 = t105 * t215;
    const T t315 = t313 - t314;
    const T t316 = t80 * t252;
    const T t317 = t277 - t316;
    const T t318 = t83 * t250;
    const T t319 = t317 + t318;
    const T t320 = t288 - t319;
    const T t321 = t290 - t320;
    const T t322 = t292 - t321;
    const T t323 = t80 * t261;
    const T t324 = t294 - t323;
    const T t325 = t83 * t259;
    const T t326 = t324 + t325;
    const T t327 = t299 - t326;
    const T t328 = t301 - t327;
    const T t329 = t303 - t328;
    const T t330 = t80 * t270;
    const T t331 = t305 - t330;
    const T t332 = t83 * t268;
    const T t333 = t331 + t332;
    const T t334 = t310 - t333;
    const T t335 = t312 - t334;
    const T t336 = t314 - t335;
    const T t337 = t111 * t191;
    const T t338 = t24 * t163;
    const T t339 = t337 - t338;
    const T t340 = t83 * t188;
    const T t341 = t339 - t340;
    const T t342 = t78 * t287;
    const T t343 = t341 + t342;
    const T t344 = t76 * t199;
    const T t345 = t343 + t344;
    const T t346 = t65 * t215;
    const T t347 = t345 - t346;
    const T t348 = t111 * t225;
    const T t349 = t24 * t218;
    const T t350 = t348 - t349;
    const T t351 = t83 * t222;
    const T t352 = t350 - t351;
    const T t353 = t90 * t287;
    const T t354 = t352 + t353;
    const T t355 = t88 * t199;
    const T t356 = t354 + t355;
    const T t357 = t86 * t215;
    const T t358 = t356 - t357;
    const T t359 = t111 * t241;
    const T t360 = t24 * t234;
    const T t361 = t359 - t360;
    const T t362 = t83 * t238;
    const T t363 = t361 - t362;
    const T t364 = t105 * t287;
    const T t365 = t363 + t364;
    const T t366 = t103 * t199;
    const T t367 = t365 + t366;
    const T t368 = t98 * t215;
    const T t369 = t367 - t368;
    const T t370 = t111 * t250;
    const T t371 = t24 * t252;
    const T t372 = t370 - t371;
    const T t373 = t340 - t372;
    const T t374 = t342 - t373;
    const T t375 = t344 + t374;
    const T t376 = t346 - t375;
    const T t377 = t111 * t259;
    const T t378 = t24 * t261;
    const T t379 = t377 - t378;
    const T t380 = t351 - t379;
    const T t381 = t353 - t380;
    const T t382 = t355 + t381;
    const T t383 = t357 - t382;
    const T t384 = t111 * t268;
    const T t385 = t24 * t270;
    const T t386 = t384 - t385;
    const T t387 = t362 - t386;
    const T t388 = t364 - t387;
    const T t389 = t366 + t388;
    const T t390 = t368 - t389;
    const T t391 = t80 * t191;
    const T t392 = t24 * t188;
    const T t393 = t391 - t392;
    const T t394 = t83 * t163;
    const T t395 = t393 + t394;
    const T t396 = t76 * t287;
    const T t397 = t395 + t396;
    const T t398 = t78 * t199;
    const T t399 = t397 - t398;
    const T t400 = t65 * t207;
    const T t401 = t399 + t400;
    const T t402 = t80 * t225;
    const T t403 = t24 * t222;
    const T t404 = t402 - t403;
    const T t405 = t83 * t218;
    const T t406 = t404 + t405;
    const T t407 = t88 * t287;
    const T t408 = t406 + t407;
    const T t409 = t90 * t199;
    const T t410 = t408 - t409;
    const T t411 = t86 * t207;
    const T t412 = t410 + t411;
    const T t413 = t80 * t241;
    const T t414 = t24 * t238;
    const T t415 = t413 - t414;
    const T t416 = t83 * t234;
    const T t417 = t415 + t416;
    const T t418 = t103 * t287;
    const T t419 = t417 + t418;
    const T t420 = t105 * t199;
    const T t421 = t419 - t420;
    const T t422 = t98 * t207;
    const T t423 = t421 + t422;
    const T t424 = t83 * t252;
    const T t425 = t80 * t250;
    const T t426 = t392 - t425;
    const T t427 = t424 - t426;
    const T t428 = t396 + t427;
    const T t429 = t398 - t428;
    const T t430 = t400 - t429;
    const T t431 = t83 * t261;
    const T t432 = t80 * t259;
    const T t433 = t403 - t432;
    const T t434 = t431 - t433;
    const T t435 = t407 + t434;
    const T t436 = t409 - t435;
    const T t437 = t411 - t436;
    const T t438 = t83 * t270;
    const T t439 = t80 * t268;
    const T t440 = t414 - t439;
    const T t441 = t438 - t440;
    const T t442 = t418 + t441;
    const T t443 = t420 - t442;
    const T t444 = t422 - t443;
    out[0] = -t85;
    out[1] = t95;
    out[2] = t110;
    out[3] = t85;
    out[4] = -t95;
    out[5] = -t110;
    out[6] = -t116;
    out[7] = t121;
    out[8] = t126;
    out[9] = t116;
    out[10] = -t121;
    out[11] = -t126;
    out[12] = -t131;
    out[13] = t136;
    out[14] = t141;
    out[15] = t131;
    out[16] = -t136;
    out[17] = -t141;
    out[18] = -t146;
    out[19] = t151;
    out[20] = t156;
    out[21] = t146;
    out[22] = -t151;
    out[23] = -t156;
    out[24] = K(0.0);
    out[25] = K(0.0);
    out[26] = K(0.0);
    out[27] = K(0.0);
    out[28] = K(0.0);
    out[29] = K(0.0);
    out[30] = -t217;
    out[31] = t233;
    out[32] = t249;
    out[33] = t258;
    out[34] = -t267;
    out[35] = -t276;
    out[36] = -t293;
    out[37] = t304;
    out[38] = t315;
    out[39] = -t322;
    out[40] = t329;
    out[41] = t336;
    out[42] = K(0.0);
    out[43] = K(0.0);
    out[44] = K(0.0);
    out[45] = K(0.0);
    out[46] = K(0.0);
    out[47] = K(0.0);
    out[48] = t347;
    out[49] = -t358;
    out[50] = -t369;
    out[51] = t376;
    out[52] = -t383;
    out[53] = -t390;
    out[54] = K(0.0);
    out[55] = K(0.0);
    out[56] = K(0.0);
    out[57] = K(0.0);
    out[58] = K(0.0);
    out[59] = K(0.0);
    out[60] = K(0.0);
    out[61] = K(0.0);
    out[62] = K(0.0);
    out[63] = K(0.0);
    out[64] = K(0.0);
    out[65] = K(0.0);
    out[66] = t401;
    out[67] = -t412;
    out[68] = -t423;
    out[69] = -t430;
    out[70] = t437;
    out[71] = t444;
}

CGA_EXPORT int cga_cooperative_line_analytic_jacobian(const double *restrict points /* 6 */, const double *restrict chart /* 1 */, double *restrict out /* 72 */)
{
    cga_cooperative_line_analytic_jacobian_body(points, chart, out);
    return cga_not_finite(points, 6) || cga_not_finite(chart, 1);
}

CGA_EXPORT int cga_cooperative_line_analytic_jacobian_batch(int64_t n, const double *restrict points /* 6 */, const double *restrict chart /* 1 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_line_analytic_jacobian(points + k * 6, chart + k * 1, out + k * 72);
    return bad;
}

/* J_G = -2 ~V dV by the points, rows e12 e13 e23 e0i e1i e2i e3i, in the primitive's own frame (paper A, eq. 30). From cga_codegen.kernels.similarity.geometric_jacobian.
   81 mul, 44 add, 14 div, 2 sqrt. */
static inline void cga_cooperative_line_geometric_jacobian_body(const T *restrict points, const T *restrict chart, T *restrict out)
{
    const T t0 = K(1.0) - chart[0];
    const T t1 = K(0.5) * t0;
    const T t2 = points[3] - points[0];
    const T t3 = t2 * t2;
    const T t4 = points[4] - points[1];
    const T t5 = t4 * t4;
    const T t6 = t3 + t5;
    const T t7 = points[5] - points[2];
    const T t8 = t7 * t7;
    const T t9 = t6 + t8;
    const T t10 = ROOT(t9);
    const T t11 = t2 / t10;
    const T t12 = t11 * t11;
    const T t13 = t4 / t10;
    const T t14 = chart[0] + t13;
    const T t15 = t14 * t14;
    const T t16 = t12 + t15;
    const T t17 = t7 / t10;
    const T t18 = t17 * t17;
    const T t19 = t16 + t18;
    const T t20 = ROOT(t19);
    const T t21 = t11 / t20;
    const T t22 = chart[0] * t21;
    const T t23 = t1 * t22;
    const T t24 = t23 * t23;
    const T t25 = K(1.0) + chart[0];
    const T t26 = K(0.5) * t25;
    const T t27 = t22 * t26;
    const T t28 = t27 * t27;
    const T t29 = t24 + t28;
    const T t30 = t29 * K(2.0);
    const T t31 = K(1.0) - t30;
    const T t32 = t14 / t20;
    const T t33 = chart[0] * t32;
    const T t34 = t26 * t33;
    const T t35 = t17 / t20;
    const T t36 = chart[0] * t35;
    const T t37 = t1 * t36;
    const T t38 = t34 - t37;
    const T t39 = t27 * t38;
    const T t40 = t26 * t36;
    const T t41 = t1 * t33;
    const T t42 = t40 + t41;
    const T t43 = t23 * t42;
    const T t44 = t39 - t43;
    const T t45 = K(2.0) * t44;
    const T t46 = t2 * t45;
    const T t47 = t42 * t42;
    const T t48 = t28 + t47;
    const T t49 = K(2.0) * t48;
    const T t50 = K(1.0) - t49;
    const T t51 = t4 * t50;
    const T t52 = t46 + t51;
    const T t53 = t23 * t27;
    const T t54 = t38 * t42;
    const T t55 = t53 + t54;
    const T t56 = K(2.0) * t55;
    const T t57 = t7 * t56;
    const T t58 = t52 + t57;
    const T t59 = t31 / t58;
    const T t60 = t39 + t43;
    const T t61 = K(2.0) * t60;
    const T t62 = t61 / t58;
    const T t63 = t23 * t38;
    const T t64 = t27 * t42;
    const T t65 = t63 - t64;
    const T t66 = K(2.0) * t65;
    const T t67 = t66 / t58;
    const T t68 = t53 - t54;
    const T t69 = K(2.0) * t68;
    const T t70 = chart[0] * t69;
    const T t71 = K(2.0) * t70;
    const T t72 = t71 / t19;
    const T t73 = t59 * t72;
    const T t74 = chart[0] * t61;
    const T t75 = K(2.0) * t74;
    const T t76 = t75 / t19;
    const T t77 = t63 + t64;
    const T t78 = K(2.0) * t77;
    const T t79 = t78 / t58;
    const T t80 = t76 * t79;
    const T t81 = t73 - t80;
    const T t82 = t62 * t72;
    const T t83 = t69 / t58;
    const T t84 = t76 * t83;
    const T t85 = t82 - t84;
    const T t86 = t67 * t72;
    const T t87 = t24 + t47;
    const T t88 = K(2.0) * t87;
    const T t89 = K(1.0) - t88;
    const T t90 = t89 / t58;
    const T t91 = t76 * t90;
    const T t92 = t86 + t91;
    const T t93 = points[0] * t45;
    const T t94 = points[1] * t50;
    const T t95 = t93 + t94;
    const T t96 = points[2] * t56;
    const T t97 = t95 + t96;
    const T t98 = t58 + t97;
    const T t99 = t59 * t98;
    const T t100 = t62 * t98;
    const T t101 = t67 * t98;
    const T t102 = t59 * t97;
    const T t103 = t62 * t97;
    const T t104 = t67 * t97;
    const T t105 = points[0] * t11;
    const T t106 = points[1] * t13;
    const T t107 = t105 + t106;
    const T t108 = points[2] * t17;
    const T t109 = t107 + t108;
    const T t110 = t11 * t109;
    const T t111 = points[0] - t110;
    const T t112 = t31 * t111;
    const T t113 = t13 * t109;
    const T t114 = points[1] - t113;
    const T t115 = t61 * t114;
    const T t116 = t112 - t115;
    const T t117 = t17 * t109;
    const T t118 = points[2] - t117;
    const T t119 = t66 * t118;
    const T t120 = t116 + t119;
    const T t121 = t59 * t120;
    const T t122 = t78 * t111;
    const T t123 = t69 * t114;
    const T t124 = t122 - t123;
    const T t125 = t89 * t118;
    const T t126 = t124 - t125;
    const T t127 = t79 * t126;
    const T t128 = t121 + t127;
    const T t129 = t62 * t120;
    const T t130 = t83 * t126;
    const T t131 = t129 + t130;
    const T t132 = t67 * t120;
    const T t133 = t90 * t126;
    const T t134 = t132 - t133;
    const T t135 = t79 * t98;
    const T t136 = t83 * t98;
    const T t137 = t90 * t98;
    const T t138 = t79 * t97;
    const T t139 = t83 * t97;
    const T t140 = t90 * t97;
    out[0] = t59;
    out[1] = -t62;
    out[2] = t67;
    out[3] = -t59;
    out[4] = t62;
    out[5] = -t67;
    out[6] = t81;
    out[7] = -t85;
    out[8] = t92;
    out[9] = -t81;
    out[10] = t85;
    out[11] = -t92;
    out[12] = t79;
    out[13] = -t83;
    out[14] = -t90;
    out[15] = -t79;
    out[16] = t83;
    out[17] = t90;
    out[18] = K(0.0);
    out[19] = K(0.0);
    out[20] = K(0.0);
    out[21] = K(0.0);
    out[22] = K(0.0);
    out[23] = K(0.0);
    out[24] = t99;
    out[25] = -t100;
    out[26] = t101;
    out[27] = -t102;
    out[28] = t103;
    out[29] = -t104;
    out[30] = t128;
    out[31] = -t131;
    out[32] = t134;
    out[33] = -t128;
    out[34] = t131;
    out[35] = -t134;
    out[36] = -t135;
    out[37] = t136;
    out[38] = t137;
    out[39] = t138;
    out[40] = -t139;
    out[41] = -t140;
}

CGA_EXPORT int cga_cooperative_line_geometric_jacobian(const double *restrict points /* 6 */, const double *restrict chart /* 1 */, double *restrict out /* 42 */)
{
    cga_cooperative_line_geometric_jacobian_body(points, chart, out);
    return cga_not_finite(points, 6) || cga_not_finite(chart, 1);
}

CGA_EXPORT int cga_cooperative_line_geometric_jacobian_batch(int64_t n, const double *restrict points /* 6 */, const double *restrict chart /* 1 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_line_geometric_jacobian(points + k * 6, chart + k * 1, out + k * 42);
    return bad;
}

/* The geometric Jacobian without the motions that leave the primitive where it is: rows of the controllable blades, others zero. From cga_codegen.kernels.similarity.horizontal_jacobian.
   53 mul, 29 add, 12 div, 2 sqrt. */
static inline void cga_cooperative_line_horizontal_jacobian_body(const T *restrict points, const T *restrict chart, T *restrict out)
{
    const T t0 = K(1.0) - chart[0];
    const T t1 = K(0.5) * t0;
    const T t2 = points[3] - points[0];
    const T t3 = t2 * t2;
    const T t4 = points[4] - points[1];
    const T t5 = t4 * t4;
    const T t6 = t3 + t5;
    const T t7 = points[5] - points[2];
    const T t8 = t7 * t7;
    const T t9 = t6 + t8;
    const T t10 = ROOT(t9);
    const T t11 = t2 / t10;
    const T t12 = t11 * t11;
    const T t13 = t4 / t10;
    const T t14 = chart[0] + t13;
    const T t15 = t14 * t14;
    const T t16 = t12 + t15;
    const T t17 = t7 / t10;
    const T t18 = t17 * t17;
    const T t19 = t16 + t18;
    const T t20 = ROOT(t19);
    const T t21 = t11 / t20;
    const T t22 = chart[0] * t21;
    const T t23 = t1 * t22;
    const T t24 = t23 * t23;
    const T t25 = K(1.0) + chart[0];
    const T t26 = K(0.5) * t25;
    const T t27 = t22 * t26;
    const T t28 = t27 * t27;
    const T t29 = t24 + t28;
    const T t30 = t29 * K(2.0);
    const T t31 = K(1.0) - t30;
    const T t32 = t14 / t20;
    const T t33 = chart[0] * t32;
    const T t34 = t26 * t33;
    const T t35 = t17 / t20;
    const T t36 = chart[0] * t35;
    const T t37 = t1 * t36;
    const T t38 = t34 - t37;
    const T t39 = t27 * t38;
    const T t40 = t26 * t36;
    const T t41 = t1 * t33;
    const T t42 = t40 + t41;
    const T t43 = t23 * t42;
    const T t44 = t39 - t43;
    const T t45 = K(2.0) * t44;
    const T t46 = t2 * t45;
    const T t47 = t42 * t42;
    const T t48 = t28 + t47;
    const T t49 = K(2.0) * t48;
    const T t50 = K(1.0) - t49;
    const T t51 = t4 * t50;
    const T t52 = t46 + t51;
    const T t53 = t23 * t27;
    const T t54 = t38 * t42;
    const T t55 = t53 + t54;
    const T t56 = K(2.0) * t55;
    const T t57 = t7 * t56;
    const T t58 = t52 + t57;
    const T t59 = t31 / t58;
    const T t60 = t39 + t43;
    const T t61 = K(2.0) * t60;
    const T t62 = t61 / t58;
    const T t63 = t23 * t38;
    const T t64 = t27 * t42;
    const T t65 = t63 - t64;
    const T t66 = K(2.0) * t65;
    const T t67 = t66 / t58;
    const T t68 = t63 + t64;
    const T t69 = K(2.0) * t68;
    const T t70 = t69 / t58;
    const T t71 = t53 - t54;
    const T t72 = K(2.0) * t71;
    const T t73 = t72 / t58;
    const T t74 = t24 + t47;
    const T t75 = K(2.0) * t74;
    const T t76 = K(1.0) - t75;
    const T t77 = t76 / t58;
    const T t78 = points[0] * t45;
    const T t79 = points[1] * t50;
    const T t80 = t78 + t79;
    const T t81 = points[2] * t56;
    const T t82 = t80 + t81;
    const T t83 = t58 + t82;
    const T t84 = t59 * t83;
    const T t85 = t62 * t83;
    const T t86 = t67 * t83;
    const T t87 = t59 * t82;
    const T t88 = t62 * t82;
    const T t89 = t67 * t82;
    const T t90 = t70 * t83;
    const T t91 = t73 * t83;
    const T t92 = t77 * t83;
    const T t93 = t70 * t82;
    const T t94 = t73 * t82;
    const T t95 = t77 * t82;
    out[0] = t59;
    out[1] = -t62;
    out[2] = t67;
    out[3] = -t59;
    out[4] = t62;
    out[5] = -t67;
    out[6] = K(0.0);
    out[7] = K(0.0);
    out[8] = K(0.0);
    out[9] = K(0.0);
    out[10] = K(0.0);
    out[11] = K(0.0);
    out[12] = t70;
    out[13] = -t73;
    out[14] = -t77;
    out[15] = -t70;
    out[16] = t73;
    out[17] = t77;
    out[18] = K(0.0);
    out[19] = K(0.0);
    out[20] = K(0.0);
    out[21] = K(0.0);
    out[22] = K(0.0);
    out[23] = K(0.0);
    out[24] = t84;
    out[25] = -t85;
    out[26] = t86;
    out[27] = -t87;
    out[28] = t88;
    out[29] = -t89;
    out[30] = K(0.0);
    out[31] = K(0.0);
    out[32] = K(0.0);
    out[33] = K(0.0);
    out[34] = K(0.0);
    out[35] = K(0.0);
    out[36] = -t90;
    out[37] = t91;
    out[38] = t92;
    out[39] = t93;
    out[40] = -t94;
    out[41] = -t95;
}

CGA_EXPORT int cga_cooperative_line_horizontal_jacobian(const double *restrict points /* 6 */, const double *restrict chart /* 1 */, double *restrict out /* 42 */)
{
    cga_cooperative_line_horizontal_jacobian_body(points, chart, out);
    return cga_not_finite(points, 6) || cga_not_finite(chart, 1);
}

CGA_EXPORT int cga_cooperative_line_horizontal_jacobian_batch(int64_t n, const double *restrict points /* 6 */, const double *restrict chart /* 1 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_line_horizontal_jacobian(points + k * 6, chart + k * 1, out + k * 42);
    return bad;
}

/* Time derivative of `geometric_jacobian` where the points move with `velocities` (m/s). From cga_codegen.kernels.similarity.geometric_jacobian_derivative.
   209 mul, 138 add, 44 div, 2 sqrt. */
static inline void cga_cooperative_line_geometric_jacobian_derivative_body(const T *restrict points, const T *restrict chart, const T *restrict velocities, T *restrict out)
{
    const T t0 = K(1.0) - chart[0];
    const T t1 = K(0.5) * t0;
    const T t2 = points[3] - points[0];
    const T t3 = t2 * t2;
    const T t4 = points[4] - points[1];
    const T t5 = t4 * t4;
    const T t6 = t3 + t5;
    const T t7 = points[5] - points[2];
    const T t8 = t7 * t7;
    const T t9 = t6 + t8;
    const T t10 = ROOT(t9);
    const T t11 = t2 / t10;
    const T t12 = t11 * t11;
    const T t13 = t4 / t10;
    const T t14 = chart[0] + t13;
    const T t15 = t14 * t14;
    const T t16 = t12 + t15;
    const T t17 = t7 / t10;
    const T t18 = t17 * t17;
    const T t19 = t16 + t18;
    const T t20 = ROOT(t19);
    const T t21 = t11 / t20;
    const T t22 = chart[0] * t21;
    const T t23 = t1 * t22;
    const T t24 = t23 * K(2.0);
    const T t25 = velocities[3] - velocities[0];
    const T t26 = t25 / t10;
    const T t27 = t11 / t10;
    const T t28 = t2 * K(2.0);
    const T t29 = t25 * t28;
    const T t30 = t4 * K(2.0);
    const T t31 = velocities[4] - velocities[1];
    const T t32 = t30 * t31;
    const T t33 = t29 + t32;
    const T t34 = t7 * K(2.0);
    const T t35 = velocities[5] - velocities[2];
    const T t36 = t34 * t35;
    const T t37 = t33 + t36;
    const T t38 = t10 * K(2.0);
    const T t39 = t37 / t38;
    const T t40 = t27 * t39;
    const T t41 = t26 - t40;
    const T t42 = t41 / t20;
    const T t43 = t21 / t20;
    const T t44 = t11 * K(2.0);
    const T t45 = t41 * t44;
    const T t46 = t14 * K(2.0);
    const T t47 = t31 / t10;
    const T t48 = t13 / t10;
    const T t49 = t39 * t48;
    const T t50 = t47 - t49;
    const T t51 = t46 * t50;
    const T t52 = t45 + t51;
    const T t53 = t17 * K(2.0);
    const T t54 = t35 / t10;
    const T t55 = t17 / t10;
    const T t56 = t39 * t55;
    const T t57 = t54 - t56;
    const T t58 = t53 * t57;
    const T t59 = t52 + t58;
    const T t60 = t20 * K(2.0);
    const T t61 = t59 / t60;
    const T t62 = t43 * t61;
    const T t63 = t42 - t62;
    const T t64 = chart[0] * t63;
    const T t65 = t1 * t64;
    const T t66 = t24 * t65;
    const T t67 = K(1.0) + chart[0];
    const T t68 = K(0.5) * t67;
    const T t69 = t22 * t68;
    const T t70 = K(2.0) * t69;
    const T t71 = t64 * t68;
    const T t72 = t70 * t71;
    const T t73 = t66 + t72;
    const T t74 = K(2.0) * t73;
    const T t75 = t14 / t20;
    const T t76 = chart[0] * t75;
    const T t77 = t68 * t76;
    const T t78 = t17 / t20;
    const T t79 = chart[0] * t78;
    const T t80 = t1 * t79;
    const T t81 = t77 - t80;
    const T t82 = t69 * t81;
    const T t83 = t68 * t79;
    const T t84 = t1 * t76;
    const T t85 = t83 + t84;
    const T t86 = t23 * t85;
    const T t87 = t82 - t86;
    const T t88 = K(2.0) * t87;
    const T t89 = t2 * t88;
    const T t90 = t85 * t85;
    const T t91 = t69 * t69;
    const T t92 = t90 + t91;
    const T t93 = K(2.0) * t92;
    const T t94 = K(1.0) - t93;
    const T t95 = t4 * t94;
    const T t96 = t89 + t95;
    const T t97 = t23 * t69;
    const T t98 = t81 * t85;
    const T t99 = t97 + t98;
    const T t100 = K(2.0) * t99;
    const T t101 = t7 * t100;
    const T t102 = t96 + t101;
    const T t103 = t74 / t102;
    const T t104 = t23 * t23;
    const T t105 = t91 + t104;
    const T t106 = K(2.0) * t105;
    const T t107 = K(1.0) - t106;
    const T t108 = t107 / t102;
    const T t109 = t108 / t102;
    const T t110 = t50 / t20;
    const T t111 = t75 / t20;
    const T t112 = t61 * t111;
    const T t113 = t110 - t112;
    const T t114 = chart[0] * t113;
    const T t115 = t68 * t114;
    const T t116 = t57 / t20;
    const T t117 = t78 / t20;
    const T t118 = t61 * t117;
    const T t119 = t116 - t118;
    const T t120 = chart[0] * t119;
    const T t121 = t1 * t120;
    const T t122 = t115 - t121;
    const T t123 = t69 * t122;
    const T t124 = t71 * t81;
    const T t125 = t123 + t124;
    const T t126 = t68 * t120;
    const T t127 = t1 * t114;
    const T t128 = t126 + t127;
    const T t129 = t23 * t128;
    const T t130 = t65 * t85;
    const T t131 = t129 + t130;
    const T t132 = t125 - t131;
    const T t133 = K(2.0) * t132;
    const T t134 = t2 * t133;
    const T t135 = t25 * t88;
    const T t136 = t134 + t135;
    const T t137 = t31 * t94;
    const T t138 = K(2.0) * t85;
    const T t139 = t128 * t138;
    const T t140 = t72 + t139;
    const T t141 = K(2.0) * t140;
    const T t142 = t4 * t141;
    const T t143 = t137 - t142;
    const T t144 = t136 + t143;
    const T t145 = t65 * t69;
    const T t146 = t23 * t71;
    const T t147 = t145 + t146;
    const T t148 = t85 * t122;
    const T t149 = t81 * t128;
    const T t150 = t148 + t149;
    const T t151 = t147 + t150;
    const T t152 = K(2.0) * t151;
    const T t153 = t7 * t152;
    const T t154 = t35 * t100;
    const T t155 = t153 + t154;
    const T t156 = t144 + t155;
    const T t157 = t109 * t156;
    const T t158 = t103 + t157;
    const T t159 = t125 + t131;
    const T t160 = K(2.0) * t159;
    const T t161 = t160 / t102;
    const T t162 = t82 + t86;
    const T t163 = K(2.0) * t162;
    const T t164 = t163 / t102;
    const T t165 = t164 / t102;
    const T t166 = t156 * t165;
    const T t167 = t161 - t166;
    const T t168 = t23 * t122;
    const T t169 = t65 * t81;
    const T t170 = t168 + t169;
    const T t171 = t69 * t128;
    const T t172 = t71 * t85;
    const T t173 = t171 + t172;
    const T t174 = t170 - t173;
    const T t175 = K(2.0) * t174;
    const T t176 = t175 / t102;
    const T t177 = t23 * t81;
    const T t178 = t69 * t85;
    const T t179 = t177 - t178;
    const T t180 = K(2.0) * t179;
    const T t181 = t180 / t102;
    const T t182 = t181 / t102;
    const T t183 = t156 * t182;
    const T t184 = t176 - t183;
    const T t185 = t147 - t150;
    const T t186 = K(2.0) * t185;
    const T t187 = chart[0] * t186;
    const T t188 = K(2.0) * t187;
    const T t189 = t188 / t19;
    const T t190 = t97 - t98;
    const T t191 = K(2.0) * t190;
    const T t192 = chart[0] * t191;
    const T t193 = K(2.0) * t192;
    const T t194 = t193 / t19;
    const T t195 = t194 / t19;
    const T t196 = t59 * t195;
    const T t197 = t189 - t196;
    const T t198 = t108 * t197;
    const T t199 = t158 * t194;
    const T t200 = t198 - t199;
    const T t201 = t177 + t178;
    const T t202 = K(2.0) * t201;
    const T t203 = t202 / t102;
    const T t204 = chart[0] * t160;
    const T t205 = K(2.0) * t204;
    const T t206 = t205 / t19;
    const T t207 = chart[0] * t163;
    const T t208 = K(2.0) * t207;
    const T t209 = t208 / t19;
    const T t210 = t209 / t19;
    const T t211 = t59 * t210;
    const T t212 = t206 - t211;
    const T t213 = t203 * t212;
    const T t214 = t170 + t173;
    const T t215 = K(2.0) * t214;
    const T t216 = t215 / t102;
    const T t217 = t203 / t102;
    const T t218 = t156 * t217;
    const T t219 = t216 - t218;
    const T t220 = t209 * t219;
    const T t221 = t213 + t220;
    const T t222 = t200 - t221;
    const T t223 = t164 * t197;
    const T t224 = t167 * t194;
    const T t225 = t223 + t224;
    const T t226 = t191 / t102;
    const T t227 = t212 * t226;
    const T t228 = t186 / t102;
    const T t229 = t226 / t102;
    const T t230 = t156 * t229;
    const T t231 = t228 - t230;
    const T t232 = t209 * t231;
    const T t233 = t227 + t232;
    const T t234 = t225 - t233;
    const T t235 = t181 * t197;
    const T t236 = t184 * t194;
    const T t237 = t235 + t236;
    const T t238 = t90 + t104;
    const T t239 = K(2.0) * t238;
    const T t240 = K(1.0) - t239;
    const T t241 = t240 / t102;
    const T t242 = t212 * t241;
    const T t243 = t66 + t139;
    const T t244 = K(2.0) * t243;
    const T t245 = t244 / t102;
    const T t246 = t241 / t102;
    const T t247 = t156 * t246;
    const T t248 = t245 + t247;
    const T t249 = t209 * t248;
    const T t250 = t242 - t249;
    const T t251 = t237 + t250;
    const T t252 = points[0] * t133;
    const T t253 = velocities[0] * t88;
    const T t254 = t252 + t253;
    const T t255 = velocities[1] * t94;
    const T t256 = points[1] * t141;
    const T t257 = t255 - t256;
    const T t258 = t254 + t257;
    const T t259 = points[2] * t152;
    const T t260 = velocities[2] * t100;
    const T t261 = t259 + t260;
    const T t262 = t258 + t261;
    const T t263 = t156 + t262;
    const T t264 = t108 * t263;
    const T t265 = points[0] * t88;
    const T t266 = points[1] * t94;
    const T t267 = t265 + t266;
    const T t268 = points[2] * t100;
    const T t269 = t267 + t268;
    const T t270 = t102 + t269;
    const T t271 = t158 * t270;
    const T t272 = t264 - t271;
    const T t273 = t164 * t263;
    const T t274 = t167 * t270;
    const T t275 = t273 + t274;
    const T t276 = t181 * t263;
    const T t277 = t184 * t270;
    const T t278 = t276 + t277;
    const T t279 = t108 * t262;
    const T t280 = t158 * t269;
    const T t281 = t279 - t280;
    const T t282 = t164 * t262;
    const T t283 = t167 * t269;
    const T t284 = t282 + t283;
    const T t285 = t181 * t262;
    const T t286 = t184 * t269;
    const T t287 = t285 + t286;
    const T t288 = points[0] * t41;
    const T t289 = t11 * velocities[0];
    const T t290 = t288 + t289;
    const T t291 = points[1] * t50;
    const T t292 = t13 * velocities[1];
    const T t293 = t291 + t292;
    const T t294 = t290 + t293;
    const T t295 = points[2] * t57;
    const T t296 = t17 * velocities[2];
    const T t297 = t295 + t296;
    const T t298 = t294 + t297;
    const T t299 = t11 * t298;
    const T t300 = points[0] * t11;
    const T t301 = points[1] * t13;
    const T t302 = t300 + t301;
    const T t303 = points[2] * t17;
    const T t304 = t302 + t303;
    const T t305 = t41 * t304;
    const T t306 = t299 + t305;
    const T t307 = velocities[0] - t306;
    const T t308 = t107 * t307;
    const T t309 = t11 * t304;
    const T t310 = points[0] - t309;
    const T t311 = t74 * t310;
    const T t312 = t308 - t311;
    const T t313 = t13 * t304;
    const T t314 = points[1] - t313;
    const T t315 = t160 * t314;
    const T t316 = t13 * t298;
    const T t317 = t50 * t304;
    const T t318 = t316 + t317;
    const T t319 = velocities[1] - t318;
    const T t320 = t163 * t319;
    const T t321 = t315 + t320;
    const T t322 = t312 - t321;
    const T t323 = t17 * t304;
    const T t324 = points[2] - t323;
    const T t325 = t175 * t324;
    const T t326 = t17 * t298;
    const T t327 = t57 * t304;
    const T t328 = t326 + t327;
    const T t329 = velocities[2] - t328;
    const T t330 = t180 * t329;
    const T t331 = t325 + t330;
    const T t332 = t322 + t331;
    const T t333 = t108 * t332;
    const T t334 = t107 * t310;
    const T t335 = t163 * t314;
    const T t336 = t334 - t335;
    const T t337 = t180 * t324;
    const T t338 = t336 + t337;
    const T t339 = t158 * t338;
    const T t340 = t333 - t339;
    const T t341 = t215 * t310;
    const T t342 = t202 * t307;
    const T t343 = t341 + t342;
    const T t344 = t186 * t314;
    const T t345 = t191 * t319;
    const T t346 = t344 + t345;
    const T t347 = t343 - t346;
    const T t348 = t240 * t329;
    const T t349 = t244 * t324;
    const T t350 = t348 - t349;
    const T t351 = t347 - t350;
    const T t352 = t203 * t351;
    const T t353 = t202 * t310;
    const T t354 = t191 * t314;
    const T t355 = t353 - t354;
    const T t356 = t240 * t324;
    const T t357 = t355 - t356;
    const T t358 = t219 * t357;
    const T t359 = t352 + t358;
    const T t360 = t340 + t359;
    const T t361 = t164 * t332;
    const T t362 = t167 * t338;
    const T t363 = t361 + t362;
    const T t364 = t226 * t351;
    const T t365 = t231 * t357;
    const T t366 = t364 + t365;
    const T t367 = t363 + t366;
    const T t368 = t181 * t332;
    const T t369 = t184 * t338;
    const T t370 = t368 + t369;
    const T t371 = t241 * t351;
    const T t372 = t248 * t357;
    const T t373 = t371 - t372;
    const T t374 = t370 - t373;
    const T t375 = t203 * t263;
    const T t376 = t219 * t270;
    const T t377 = t375 + t376;
    const T t378 = t226 * t263;
    const T t379 = t231 * t270;
    const T t380 = t378 + t379;
    const T t381 = t241 * t263;
    const T t382 = t248 * t270;
    const T t383 = t381 - t382;
    const T t384 = t203 * t262;
    const T t385 = t219 * t269;
    const T t386 = t384 + t385;
    const T t387 = t226 * t262;
    const T t388 = t231 * t269;
    const T t389 = t387 + t388;
    const T t390 = t241 * t262;
    const T t391 = t248 * t269;
    const T t392 = t390 - t391;
    out[0] = -t158;
    out[1] = -t167;
    out[2] = t184;
    out[3] = t158;
    out[4] = t167;
    out[5] = -t184;
    out[6] = t222;
    out[7] = -t234;
    out[8] = t251;
    out[9] = -t222;
    out[10] = t234;
    out[11] = -t251;
    out[12] = t219;
    out[13] = -t231;
    out[14] = t248;
    out[15] = -t219;
    out[16] = t231;
    out[17] = -t248;
    out[18] = K(0.0);
    out[19] = K(0.0);
    out[20] = K(0.0);
    out[21] = K(0.0);
    out[22] = K(0.0);
    out[23] = K(0.0);
    out[24] = t272;
    out[25] = -t275;
    out[26] = t278;
    out[27] = -t281;
    out[28] = t284;
    out[29] = -t287;
    out[30] = t360;
    out[31] = -t367;
    out[32] = t374;
    out[33] = -t360;
    out[34] = t367;
    out[35] = -t374;
    out[36] = -t377;
    out[37] = t380;
    out[38] = t383;
    out[39] = t386;
    out[40] = -t389;
    out[41] = -t392;
}

CGA_EXPORT int cga_cooperative_line_geometric_jacobian_derivative(const double *restrict points /* 6 */, const double *restrict chart /* 1 */, const double *restrict velocities /* 6 */, double *restrict out /* 42 */)
{
    cga_cooperative_line_geometric_jacobian_derivative_body(points, chart, velocities, out);
    return cga_not_finite(points, 6) || cga_not_finite(chart, 1) || cga_not_finite(velocities, 6);
}

CGA_EXPORT int cga_cooperative_line_geometric_jacobian_derivative_batch(int64_t n, const double *restrict points /* 6 */, const double *restrict chart /* 1 */, const double *restrict velocities /* 6 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_line_geometric_jacobian_derivative(points + k * 6, chart + k * 1, velocities + k * 6, out + k * 42);
    return bad;
}

/* Time derivative of `horizontal_jacobian` where the points move with `velocities` (m/s). From cga_codegen.kernels.similarity.horizontal_jacobian_derivative.
   139 mul, 88 add, 38 div, 2 sqrt. */
static inline void cga_cooperative_line_horizontal_jacobian_derivative_body(const T *restrict points, const T *restrict chart, const T *restrict velocities, T *restrict out)
{
    const T t0 = K(1.0) - chart[0];
    const T t1 = K(0.5) * t0;
    const T t2 = points[3] - points[0];
    const T t3 = t2 * t2;
    const T t4 = points[4] - points[1];
    const T t5 = t4 * t4;
    const T t6 = t3 + t5;
    const T t7 = points[5] - points[2];
    const T t8 = t7 * t7;
    const T t9 = t6 + t8;
    const T t10 = ROOT(t9);
    const T t11 = t2 / t10;
    const T t12 = t11 * t11;
    const T t13 = t4 / t10;
    const T t14 = chart[0] + t13;
    const T t15 = t14 * t14;
    const T t16 = t12 + t15;
    const T t17 = t7 / t10;
    const T t18 = t17 * t17;
    const T t19 = t16 + t18;
    const T t20 = ROOT(t19);
    const T t21 = t11 / t20;
    const T t22 = chart[0] * t21;
    const T t23 = t1 * t22;
    const T t24 = t23 * K(2.0);
    const T t25 = velocities[3] - velocities[0];
    const T t26 = t25 / t10;
    const T t27 = t11 / t10;
    const T t28 = t2 * K(2.0);
    const T t29 = t25 * t28;
    const T t30 = t4 * K(2.0);
    const T t31 = velocities[4] - velocities[1];
    const T t32 = t30 * t31;
    const T t33 = t29 + t32;
    const T t34 = t7 * K(2.0);
    const T t35 = velocities[5] - velocities[2];
    const T t36 = t34 * t35;
    const T t37 = t33 + t36;
    const T t38 = t10 * K(2.0);
    const T t39 = t37 / t38;
    const T t40 = t27 * t39;
    const T t41 = t26 - t40;
    const T t42 = t41 / t20;
    const T t43 = t21 / t20;
    const T t44 = t11 * K(2.0);
    const T t45 = t41 * t44;
    const T t46 = t14 * K(2.0);
    const T t47 = t31 / t10;
    const T t48 = t13 / t10;
    const T t49 = t39 * t48;
    const T t50 = t47 - t49;
    const T t51 = t46 * t50;
    const T t52 = t45 + t51;
    const T t53 = t17 * K(2.0);
    const T t54 = t35 / t10;
    const T t55 = t17 / t10;
    const T t56 = t39 * t55;
    const T t57 = t54 - t56;
    const T t58 = t53 * t57;
    const T t59 = t52 + t58;
    const T t60 = t20 * K(2.0);
    const T t61 = t59 / t60;
    const T t62 = t43 * t61;
    const T t63 = t42 - t62;
    const T t64 = chart[0] * t63;
    const T t65 = t1 * t64;
    const T t66 = t24 * t65;
    const T t67 = K(1.0) + chart[0];
    const T t68 = K(0.5) * t67;
    const T t69 = t22 * t68;
    const T t70 = K(2.0) * t69;
    const T t71 = t64 * t68;
    const T t72 = t70 * t71;
    const T t73 = t66 + t72;
    const T t74 = K(2.0) * t73;
    const T t75 = t14 / t20;
    const T t76 = chart[0] * t75;
    const T t77 = t68 * t76;
    const T t78 = t17 / t20;
    const T t79 = chart[0] * t78;
    const T t80 = t1 * t79;
    const T t81 = t77 - t80;
    const T t82 = t69 * t81;
    const T t83 = t68 * t79;
    const T t84 = t1 * t76;
    const T t85 = t83 + t84;
    const T t86 = t23 * t85;
    const T t87 = t82 - t86;
    const T t88 = K(2.0) * t87;
    const T t89 = t2 * t88;
    const T t90 = t85 * t85;
    const T t91 = t69 * t69;
    const T t92 = t90 + t91;
    const T t93 = K(2.0) * t92;
    const T t94 = K(1.0) - t93;
    const T t95 = t4 * t94;
    const T t96 = t89 + t95;
    const T t97 = t23 * t69;
    const T t98 = t81 * t85;
    const T t99 = t97 + t98;
    const T t100 = K(2.0) * t99;
    const T t101 = t7 * t100;
    const T t102 = t96 + t101;
    const T t103 = t74 / t102;
    const T t104 = t23 * t23;
    const T t105 = t91 + t104;
    const T t106 = K(2.0) * t105;
    const T t107 = K(1.0) - t106;
    const T t108 = t107 / t102;
    const T t109 = t108 / t102;
    const T t110 = t50 / t20;
    const T t111 = t75 / t20;
    const T t112 = t61 * t111;
    const T t113 = t110 - t112;
    const T t114 = chart[0] * t113;
    const T t115 = t68 * t114;
    const T t116 = t57 / t20;
    const T t117 = t78 / t20;
    const T t118 = t61 * t117;
    const T t119 = t116 - t118;
    const T t120 = chart[0] * t119;
    const T t121 = t1 * t120;
    const T t122 = t115 - t121;
    const T t123 = t69 * t122;
    const T t124 = t71 * t81;
    const T t125 = t123 + t124;
    const T t126 = t68 * t120;
    const T t127 = t1 * t114;
    const T t128 = t126 + t127;
    const T t129 = t23 * t128;
    const T t130 = t65 * t85;
    const T t131 = t129 + t130;
    const T t132 = t125 - t131;
    const T t133 = K(2.0) * t132;
    const T t134 = t2 * t133;
    const T t135 = t25 * t88;
    const T t136 = t134 + t135;
    const T t137 = t31 * t94;
    const T t138 = K(2.0) * t85;
    const T t139 = t128 * t138;
    const T t140 = t72 + t139;
    const T t141 = K(2.0) * t140;
    const T t142 = t4 * t141;
    const T t143 = t137 - t142;
    const T t144 = t136 + t143;
    const T t145 = t65 * t69;
    const T t146 = t23 * t71;
    const T t147 = t145 + t146;
    const T t148 = t85 * t122;
    const T t149 = t81 * t128;
    const T t150 = t148 + t149;
    const T t151 = t147 + t150;
    const T t152 = K(2.0) * t151;
    const T t153 = t7 * t152;
    const T t154 = t35 * t100;
    const T t155 = t153 + t154;
    const T t156 = t144 + t155;
    const T t157 = t109 * t156;
    const T t158 = t103 + t157;
    const T t159 = t125 + t131;
    const T t160 = K(2.0) * t159;
    const T t161 = t160 / t102;
    const T t162 = t82 + t86;
    const T t163 = K(2.0) * t162;
    const T t164 = t163 / t102;
    const T t165 = t164 / t102;
    const T t166 = t156 * t165;
    const T t167 = t161 - t166;
    const T t168 = t23 * t122;
    const T t169 = t65 * t81;
    const T t170 = t168 + t169;
    const T t171 = t69 * t128;
    const T t172 = t71 * t85;
    const T t173 = t171 + t172;
    const T t174 = t170 - t173;
    const T t175 = K(2.0) * t174;
    const T t176 = t175 / t102;
    const T t177 = t23 * t81;
    const T t178 = t69 * t85;
    const T t179 = t177 - t178;
    const T t180 = K(2.0) * t179;
    const T t181 = t180 / t102;
    const T t182 = t181 / t102;
    const T t183 = t156 * t182;
    const T t184 = t176 - t183;
    const T t185 = t170 + t173;
    const T t186 = K(2.0) * t185;
    const T t187 = t186 / t102;
    const T t188 = t177 + t178;
    const T t189 = K(2.0) * t188;
    const T t190 = t189 / t102;
    const T t191 = t190 / t102;
    const T t192 = t156 * t191;
    const T t193 = t187 - t192;
    const T t194 = t147 - t150;
    const T t195 = K(2.0) * t194;
    const T t196 = t195 / t102;
    const T t197 = t97 - t98;
    const T t198 = K(2.0) * t197;
    const T t199 = t198 / t102;
    const T t200 = t199 / t102;
    const T t201 = t156 * t200;
    const T t202 = t196 - t201;
    const T t203 = t66 + t139;
    const T t204 = K(2.0) * t203;
    const T t205 = t204 / t102;
    const T t206 = t90 + t104;
    const T t207 = K(2.0) * t206;
    const T t208 = K(1.0) - t207;
    const T t209 = t208 / t102;
    const T t210 = t209 / t102;
    const T t211 = t156 * t210;
    const T t212 = t205 + t211;
    const T t213 = points[0] * t133;
    const T t214 = velocities[0] * t88;
    const T t215 = t213 + t214;
    const T t216 = velocities[1] * t94;
    const T t217 = points[1] * t141;
    const T t218 = t216 - t217;
    const T t219 = t215 + t218;
    const T t220 = points[2] * t152;
    const T t221 = velocities[2] * t100;
    const T t222 = t220 + t221;
    const T t223 = t219 + t222;
    const T t224 = t156 + t223;
    const T t225 = t108 * t224;
    const T t226 = points[0] * t88;
    const T t227 = points[1] * t94;
    const T t228 = t226 + t227;
    const T t229 = points[2] * t100;
    const T t230 = t228 + t229;
    const T t231 = t102 + t230;
    const T t232 = t158 * t231;
    const T t233 = t225 - t232;
    const T t234 = t164 * t224;
    const T t235 = t167 * t231;
    const T t236 = t234 + t235;
    const T t237 = t181 * t224;
    const T t238 = t184 * t231;
    const T t239 = t237 + t238;
    const T t240 = t108 * t223;
    const T t241 = t158 * t230;
    const T t242 = t240 - t241;
    const T t243 = t164 * t223;
    const T t244 = t167 * t230;
    const T t245 = t243 + t244;
    const T t246 = t181 * t223;
    const T t247 = t184 * t230;
    const T t248 = t246 + t247;
    const T t249 = t190 * t224;
    const T t250 = t193 * t231;
    const T t251 = t249 + t250;
    const T t252 = t199 * t224;
    const T t253 = t202 * t231;
    const T t254 = t252 + t253;
    const T t255 = t209 * t224;
    const T t256 = t212 * t231;
    const T t257 = t255 - t256;
    const T t258 = t190 * t223;
    const T t259 = t193 * t230;
    const T t260 = t258 + t259;
    const T t261 = t199 * t223;
    const T t262 = t202 * t230;
    const T t263 = t261 + t262;
    const T t264 = t209 * t223;
    const T t265 = t212 * t230;
    const T t266 = t264 - t265;
    out[0] = -t158;
    out[1] = -t167;
    out[2] = t184;
    out[3] = t158;
    out[4] = t167;
    out[5] = -t184;
    out[6] = K(0.0);
    out[7] = K(0.0);
    out[8] = K(0.0);
    out[9] = K(0.0);
    out[10] = K(0.0);
    out[11] = K(0.0);
    out[12] = t193;
    out[13] = -t202;
    out[14] = t212;
    out[15] = -t193;
    out[16] = t202;
    out[17] = -t212;
    out[18] = K(0.0);
    out[19] = K(0.0);
    out[20] = K(0.0);
    out[21] = K(0.0);
    out[22] = K(0.0);
    out[23] = K(0.0);
    out[24] = t233;
    out[25] = -t236;
    out[26] = t239;
    out[27] = -t242;
    out[28] = t245;
    out[29] = -t248;
    out[30] = K(0.0);
    out[31] = K(0.0);
    out[32] = K(0.0);
    out[33] = K(0.0);
    out[34] = K(0.0);
    out[35] = K(0.0);
    out[36] = -t251;
    out[37] = t254;
    out[38] = t257;
    out[39] = t260;
    out[40] = -t263;
    out[41] = -t266;
}

CGA_EXPORT int cga_cooperative_line_horizontal_jacobian_derivative(const double *restrict points /* 6 */, const double *restrict chart /* 1 */, const double *restrict velocities /* 6 */, double *restrict out /* 42 */)
{
    cga_cooperative_line_horizontal_jacobian_derivative_body(points, chart, velocities, out);
    return cga_not_finite(points, 6) || cga_not_finite(chart, 1) || cga_not_finite(velocities, 6);
}

CGA_EXPORT int cga_cooperative_line_horizontal_jacobian_derivative_batch(int64_t n, const double *restrict points /* 6 */, const double *restrict chart /* 1 */, const double *restrict velocities /* 6 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_line_horizontal_jacobian_derivative(points + k * 6, chart + k * 1, velocities + k * 6, out + k * 42);
    return bad;
}

/* How far a primitive is from degenerate: |a| (m) of two points, the sine |a x b|/(|a||b|) of three, |det[a, b, d]|/(|a||b||d|) of From cga_codegen.kernels.primitives.degeneracy.
   3 mul, 6 add, 0 div, 1 sqrt. */
static inline void cga_cooperative_line_degeneracy_body(const T *restrict points, T *restrict out)
{
    const T t0 = points[3] - points[0];
    const T t1 = t0 * t0;
    const T t2 = points[4] - points[1];
    const T t3 = t2 * t2;
    const T t4 = t1 + t3;
    const T t5 = points[5] - points[2];
    const T t6 = t5 * t5;
    const T t7 = t4 + t6;
    const T t8 = t7 + K(1e-300);
    const T t9 = ROOT(t8);
    out[0] = t9;
}

CGA_EXPORT int cga_cooperative_line_degeneracy(const double *restrict points /* 6 */, double *restrict out /* 1 */)
{
    cga_cooperative_line_degeneracy_body(points, out);
    return cga_not_finite(points, 6);
}

CGA_EXPORT int cga_cooperative_line_degeneracy_batch(int64_t n, const double *restrict points /* 6 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_line_degeneracy(points + k * 6, out + k * 1);
    return bad;
}

/* What is looked at before the rest is trusted: `degeneracy`, the cosine between direction and reference direction (0 without one), and From cga_codegen.kernels.primitives.guard.
   3 mul, 6 add, 1 div, 1 sqrt. */
static inline void cga_cooperative_line_guard_body(const T *restrict points, T *restrict out)
{
    const T t0 = points[3] - points[0];
    const T t1 = t0 * t0;
    const T t2 = points[4] - points[1];
    const T t3 = t2 * t2;
    const T t4 = t1 + t3;
    const T t5 = points[5] - points[2];
    const T t6 = t5 * t5;
    const T t7 = t4 + t6;
    const T t8 = t7 + K(1e-300);
    const T t9 = ROOT(t8);
    const T t10 = t2 / t9;
    out[0] = t9;
    out[1] = t10;
    out[2] = t7;
}

CGA_EXPORT int cga_cooperative_line_guard(const double *restrict points /* 6 */, double *restrict out /* 3 */)
{
    cga_cooperative_line_guard_body(points, out);
    return cga_not_finite(points, 6);
}

CGA_EXPORT int cga_cooperative_line_guard_batch(int64_t n, const double *restrict points /* 6 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_line_guard(points + k * 6, out + k * 3);
    return bad;
}

/* Derivative of `degeneracy` by the points. From cga_codegen.kernels.primitives.degeneracy_gradient.
   3 mul, 6 add, 3 div, 1 sqrt. */
static inline void cga_cooperative_line_degeneracy_gradient_body(const T *restrict points, T *restrict out)
{
    const T t0 = points[3] - points[0];
    const T t1 = t0 * t0;
    const T t2 = points[4] - points[1];
    const T t3 = t2 * t2;
    const T t4 = t1 + t3;
    const T t5 = points[5] - points[2];
    const T t6 = t5 * t5;
    const T t7 = t4 + t6;
    const T t8 = t7 + K(1e-300);
    const T t9 = ROOT(t8);
    const T t10 = t0 / t9;
    const T t11 = t2 / t9;
    const T t12 = t5 / t9;
    out[0] = -t10;
    out[1] = -t11;
    out[2] = -t12;
    out[3] = t10;
    out[4] = t11;
    out[5] = t12;
}

CGA_EXPORT int cga_cooperative_line_degeneracy_gradient(const double *restrict points /* 6 */, double *restrict out /* 6 */)
{
    cga_cooperative_line_degeneracy_gradient_body(points, out);
    return cga_not_finite(points, 6);
}

CGA_EXPORT int cga_cooperative_line_degeneracy_gradient_batch(int64_t n, const double *restrict points /* 6 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_line_degeneracy_gradient(points + k * 6, out + k * 6);
    return bad;
}
