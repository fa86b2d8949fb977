/* The cooperative point pair from its points. Made by `cga generate`; do not edit: the loader checks digests, and the next run overwrites it. */

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
   20 mul, 14 add, 0 div, 0 sqrt. */
static inline void cga_cooperative_point_pair_primitive_body(const T *restrict points, T *restrict out)
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
    const T t12 = points[3] * points[3];
    const T t13 = points[4] * points[4];
    const T t14 = t12 + t13;
    const T t15 = points[5] * points[5];
    const T t16 = t14 + t15;
    const T t17 = K(0.5) * t16;
    const T t18 = points[0] * points[0];
    const T t19 = points[1] * points[1];
    const T t20 = t18 + t19;
    const T t21 = points[2] * points[2];
    const T t22 = t20 + t21;
    const T t23 = K(0.5) * t22;
    const T t24 = t17 - t23;
    const T t25 = points[0] * t17;
    const T t26 = points[3] * t23;
    const T t27 = t25 - t26;
    const T t28 = points[1] * t17;
    const T t29 = points[4] * t23;
    const T t30 = t28 - t29;
    const T t31 = points[2] * t17;
    const T t32 = points[5] * t23;
    const T t33 = t31 - t32;
    out[0] = t0;
    out[1] = t1;
    out[2] = t4;
    out[3] = t5;
    out[4] = t8;
    out[5] = t11;
    out[6] = t24;
    out[7] = t27;
    out[8] = t30;
    out[9] = t33;
}

CGA_EXPORT int cga_cooperative_point_pair_primitive(const double *restrict points /* 6 */, double *restrict out /* 10 */)
{
    cga_cooperative_point_pair_primitive_body(points, out);
    return cga_not_finite(points, 6);
}

CGA_EXPORT int cga_cooperative_point_pair_primitive_batch(int64_t n, const double *restrict points /* 6 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_point_pair_primitive(points + k * 6, out + k * 10);
    return bad;
}

/* Derivative of the primitive by the points: one factor after the other is replaced by its derivative (paper A, eqs. 15-17). From cga_codegen.kernels.primitives.primitive_jacobian.
   17 mul, 10 add, 0 div, 0 sqrt. */
static inline void cga_cooperative_point_pair_primitive_jacobian_body(const T *restrict points, T *restrict out)
{
    const T t0 = points[3] * points[3];
    const T t1 = points[4] * points[4];
    const T t2 = t0 + t1;
    const T t3 = points[5] * points[5];
    const T t4 = t2 + t3;
    const T t5 = K(0.5) * t4;
    const T t6 = points[3] * points[0];
    const T t7 = t5 - t6;
    const T t8 = points[3] * points[1];
    const T t9 = points[3] * points[2];
    const T t10 = points[0] * points[0];
    const T t11 = points[1] * points[1];
    const T t12 = t10 + t11;
    const T t13 = points[2] * points[2];
    const T t14 = t12 + t13;
    const T t15 = K(0.5) * t14;
    const T t16 = t6 - t15;
    const T t17 = points[4] * points[0];
    const T t18 = points[0] * points[5];
    const T t19 = points[4] * points[1];
    const T t20 = t5 - t19;
    const T t21 = points[4] * points[2];
    const T t22 = t15 - t19;
    const T t23 = points[1] * points[5];
    const T t24 = points[5] * points[2];
    const T t25 = t5 - t24;
    const T t26 = t15 - t24;
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
    out[36] = -points[0];
    out[37] = -points[1];
    out[38] = -points[2];
    out[39] = points[3];
    out[40] = points[4];
    out[41] = points[5];
    out[42] = t7;
    out[43] = -t8;
    out[44] = -t9;
    out[45] = t16;
    out[46] = t17;
    out[47] = t18;
    out[48] = -t17;
    out[49] = t20;
    out[50] = -t21;
    out[51] = t8;
    out[52] = -t22;
    out[53] = t23;
    out[54] = -t18;
    out[55] = -t23;
    out[56] = t25;
    out[57] = t9;
    out[58] = t21;
    out[59] = -t26;
}

CGA_EXPORT int cga_cooperative_point_pair_primitive_jacobian(const double *restrict points /* 6 */, double *restrict out /* 60 */)
{
    cga_cooperative_point_pair_primitive_jacobian_body(points, out);
    return cga_not_finite(points, 6);
}

CGA_EXPORT int cga_cooperative_point_pair_primitive_jacobian_batch(int64_t n, const double *restrict points /* 6 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_point_pair_primitive_jacobian(points + k * 6, out + k * 60);
    return bad;
}

/* V with V X_u ~V = X over its weight (paper A, eq. 28). From cga_codegen.kernels.similarity.similarity.
   47 mul, 25 add, 8 div, 3 sqrt. */
static inline void cga_cooperative_point_pair_similarity_body(const T *restrict points, const T *restrict chart, T *restrict out)
{
    const T t0 = points[3] - points[0];
    const T t1 = t0 * t0;
    const T t2 = points[4] - points[1];
    const T t3 = t2 * t2;
    const T t4 = t1 + t3;
    const T t5 = points[5] - points[2];
    const T t6 = t5 * t5;
    const T t7 = t4 + t6;
    const T t8 = ROOT(t7);
    const T t9 = K(0.5) * t8;
    const T t10 = ROOT(t9);
    const T t11 = K(1.0) / t10;
    const T t12 = t10 + t11;
    const T t13 = K(0.5) * t12;
    const T t14 = K(1.0) + chart[0];
    const T t15 = K(0.5) * t14;
    const T t16 = t2 / t8;
    const T t17 = chart[0] + t16;
    const T t18 = t0 / t8;
    const T t19 = t18 * t18;
    const T t20 = t17 * t17;
    const T t21 = t19 + t20;
    const T t22 = t5 / t8;
    const T t23 = t22 * t22;
    const T t24 = t21 + t23;
    const T t25 = ROOT(t24);
    const T t26 = t17 / t25;
    const T t27 = chart[0] * t26;
    const T t28 = t15 * t27;
    const T t29 = K(1.0) - chart[0];
    const T t30 = K(0.5) * t29;
    const T t31 = t22 / t25;
    const T t32 = chart[0] * t31;
    const T t33 = t30 * t32;
    const T t34 = t28 - t33;
    const T t35 = t13 * t34;
    const T t36 = t18 / t25;
    const T t37 = chart[0] * t36;
    const T t38 = t15 * t37;
    const T t39 = t13 * t38;
    const T t40 = t30 * t37;
    const T t41 = t13 * t40;
    const T t42 = t15 * t32;
    const T t43 = t27 * t30;
    const T t44 = t42 + t43;
    const T t45 = t13 * t44;
    const T t46 = t10 - t11;
    const T t47 = K(0.5) * t46;
    const T t48 = t34 * t47;
    const T t49 = K(0.5) / t10;
    const T t50 = t34 * t49;
    const T t51 = points[3] + points[0];
    const T t52 = K(0.5) * t51;
    const T t53 = t50 * t52;
    const T t54 = t38 * t49;
    const T t55 = points[4] + points[1];
    const T t56 = K(0.5) * t55;
    const T t57 = t54 * t56;
    const T t58 = t53 - t57;
    const T t59 = t40 * t49;
    const T t60 = points[5] + points[2];
    const T t61 = K(0.5) * t60;
    const T t62 = t59 * t61;
    const T t63 = t58 + t62;
    const T t64 = t50 * t56;
    const T t65 = t52 * t54;
    const T t66 = t64 + t65;
    const T t67 = t44 * t49;
    const T t68 = t61 * t67;
    const T t69 = t66 + t68;
    const T t70 = t38 * t47;
    const T t71 = t50 * t61;
    const T t72 = t52 * t59;
    const T t73 = t71 - t72;
    const T t74 = t56 * t67;
    const T t75 = t73 - t74;
    const T t76 = t40 * t47;
    const T t77 = t44 * t47;
    const T t78 = t54 * t61;
    const T t79 = t56 * t59;
    const T t80 = t78 + t79;
    const T t81 = t52 * t67;
    const T t82 = t80 - t81;
    out[0] = t35;
    out[1] = t39;
    out[2] = -t41;
    out[3] = -t45;
    out[4] = t48;
    out[5] = -t63;
    out[6] = -t69;
    out[7] = t70;
    out[8] = -t75;
    out[9] = -t76;
    out[10] = -t77;
    out[11] = -t82;
}

CGA_EXPORT int cga_cooperative_point_pair_similarity(const double *restrict points /* 6 */, const double *restrict chart /* 1 */, double *restrict out /* 12 */)
{
    cga_cooperative_point_pair_similarity_body(points, chart, out);
    return cga_not_finite(points, 6) || cga_not_finite(chart, 1);
}

CGA_EXPORT int cga_cooperative_point_pair_similarity_batch(int64_t n, const double *restrict points /* 6 */, const double *restrict chart /* 1 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_point_pair_similarity(points + k * 6, chart + k * 1, out + k * 12);
    return bad;
}

/* The factors of V: rotor 1 e12 e13 e23, centre (m), radius (m; 1 of flat ones). From cga_codegen.kernels.similarity.parts.
   21 mul, 15 add, 6 div, 2 sqrt. */
static inline void cga_cooperative_point_pair_parts_body(const T *restrict points, const T *restrict chart, T *restrict out)
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
    const T t37 = points[3] + points[0];
    const T t38 = K(0.5) * t37;
    const T t39 = points[4] + points[1];
    const T t40 = K(0.5) * t39;
    const T t41 = points[5] + points[2];
    const T t42 = K(0.5) * t41;
    const T t43 = K(0.5) * t10;
    out[0] = t29;
    out[1] = t32;
    out[2] = -t33;
    out[3] = -t36;
    out[4] = t38;
    out[5] = t40;
    out[6] = t42;
    out[7] = t43;
}

CGA_EXPORT int cga_cooperative_point_pair_parts(const double *restrict points /* 6 */, const double *restrict chart /* 1 */, double *restrict out /* 8 */)
{
    cga_cooperative_point_pair_parts_body(points, chart, out);
    return cga_not_finite(points, 6) || cga_not_finite(chart, 1);
}

CGA_EXPORT int cga_cooperative_point_pair_parts_batch(int64_t n, const double *restrict points /* 6 */, const double *restrict chart /* 1 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_point_pair_parts(points + k * 6, chart + k * 1, out + k * 8);
    return bad;
}

/* dV = -1/2 V J_G by the points (paper A, eq. 29). From cga_codegen.kernels.similarity.analytic_jacobian.
   231 mul, 295 add, 19 div, 3 sqrt. */
static inline void cga_cooperative_point_pair_analytic_jacobian_body(const T *restrict points, const T *restrict chart, T *restrict out)
{
    const T t0 = points[3] - points[0];
    const T t1 = t0 * t0;
    const T t2 = points[4] - points[1];
    const T t3 = t2 * t2;
    const T t4 = t1 + t3;
    const T t5 = points[5] - points[2];
    const T t6 = t5 * t5;
    const T t7 = t4 + t6;
    const T t8 = ROOT(t7);
    const T t9 = K(0.5) * t8;
    const T t10 = ROOT(t9);
    const T t11 = K(1.0) / t10;
    const T t12 = t10 + t11;
    const T t13 = K(0.5) * t12;
    const T t14 = K(1.0) - chart[0];
    const T t15 = K(0.5) * t14;
    const T t16 = t0 / t8;
    const T t17 = t16 * t16;
    const T t18 = t2 / t8;
    const T t19 = chart[0] + t18;
    const T t20 = t19 * t19;
    const T t21 = t17 + t20;
    const T t22 = t5 / t8;
    const T t23 = t22 * t22;
    const T t24 = t21 + t23;
    const T t25 = ROOT(t24);
    const T t26 = t16 / t25;
    const T t27 = chart[0] * t26;
    const T t28 = t15 * t27;
    const T t29 = t13 * t28;
    const T t30 = K(0.5) * t29;
    const T t31 = K(1.0) + chart[0];
    const T t32 = K(0.5) * t31;
    const T t33 = t27 * t32;
    const T t34 = t28 * t33;
    const T t35 = t19 / t25;
    const T t36 = chart[0] * t35;
    const T t37 = t32 * t36;
    const T t38 = t22 / t25;
    const T t39 = chart[0] * t38;
    const T t40 = t15 * t39;
    const T t41 = t37 - t40;
    const T t42 = t32 * t39;
    const T t43 = t15 * t36;
    const T t44 = t42 + t43;
    const T t45 = t41 * t44;
    const T t46 = t34 - t45;
    const T t47 = t46 * K(2.0);
    const T t48 = chart[0] * t47;
    const T t49 = K(2.0) * t48;
    const T t50 = t49 / t24;
    const T t51 = t28 * t28;
    const T t52 = t33 * t33;
    const T t53 = t51 + t52;
    const T t54 = K(2.0) * t53;
    const T t55 = K(1.0) - t54;
    const T t56 = t55 / t8;
    const T t57 = t50 * t56;
    const T t58 = t28 * t44;
    const T t59 = t33 * t41;
    const T t60 = t58 + t59;
    const T t61 = K(2.0) * t60;
    const T t62 = chart[0] * t61;
    const T t63 = K(2.0) * t62;
    const T t64 = t63 / t24;
    const T t65 = t33 * t44;
    const T t66 = t28 * t41;
    const T t67 = t65 + t66;
    const T t68 = K(2.0) * t67;
    const T t69 = t68 / t8;
    const T t70 = t64 * t69;
    const T t71 = t57 - t70;
    const T t72 = t30 * t71;
    const T t73 = t13 * t33;
    const T t74 = K(0.5) * t73;
    const T t75 = t56 * t74;
    const T t76 = t72 - t75;
    const T t77 = t13 * t44;
    const T t78 = K(0.5) * t77;
    const T t79 = t69 * t78;
    const T t80 = t76 + t79;
    const T t81 = t10 - t11;
    const T t82 = K(0.5) * t81;
    const T t83 = t41 * t82;
    const T t84 = K(0.5) * t83;
    const T t85 = t58 - t59;
    const T t86 = K(2.0) * t85;
    const T t87 = t86 / t8;
    const T t88 = t84 * t87;
    const T t89 = t80 - t88;
    const T t90 = t61 / t8;
    const T t91 = t50 * t90;
    const T t92 = t47 / t8;
    const T t93 = t64 * t92;
    const T t94 = t91 - t93;
    const T t95 = t30 * t94;
    const T t96 = t74 * t90;
    const T t97 = t95 - t96;
    const T t98 = t78 * t92;
    const T t99 = t97 + t98;
    const T t100 = t44 * t44;
    const T t101 = t52 + t100;
    const T t102 = K(2.0) * t101;
    const T t103 = K(1.0) - t102;
    const T t104 = t103 / t8;
    const T t105 = t84 * t104;
    const T t106 = t99 - t105;
    const T t107 = t65 - t66;
    const T t108 = K(2.0) * t107;
    const T t109 = t108 / t8;
    const T t110 = t50 * t109;
    const T t111 = t51 + t100;
    const T t112 = K(2.0) * t111;
    const T t113 = K(1.0) - t112;
    const T t114 = t113 / t8;
    const T t115 = t64 * t114;
    const T t116 = t110 - t115;
    const T t117 = t30 * t116;
    const T t118 = t74 * t109;
    const T t119 = t117 - t118;
    const T t120 = t78 * t114;
    const T t121 = t119 + t120;
    const T t122 = t34 + t45;
    const T t123 = K(2.0) * t122;
    const T t124 = t123 / t8;
    const T t125 = t84 * t124;
    const T t126 = t121 - t125;
    const T t127 = t13 * t41;
    const T t128 = K(0.5) * t127;
    const T t129 = t56 * t128;
    const T t130 = t30 * t69;
    const T t131 = t129 + t130;
    const T t132 = t71 * t78;
    const T t133 = t131 - t132;
    const T t134 = t33 * t82;
    const T t135 = K(0.5) * t134;
    const T t136 = t87 * t135;
    const T t137 = t133 - t136;
    const T t138 = t90 * t128;
    const T t139 = t30 * t92;
    const T t140 = t138 + t139;
    const T t141 = t78 * t94;
    const T t142 = t140 - t141;
    const T t143 = t104 * t135;
    const T t144 = t142 - t143;
    const T t145 = t109 * t128;
    const T t146 = t30 * t114;
    const T t147 = t145 + t146;
    const T t148 = t78 * t116;
    const T t149 = t147 - t148;
    const T t150 = t124 * t135;
    const T t151 = t149 - t150;
    const T t152 = t71 * t128;
    const T t153 = t69 * t74;
    const T t154 = t152 + t153;
    const T t155 = t56 * t78;
    const T t156 = t154 + t155;
    const T t157 = t28 * t82;
    const T t158 = K(0.5) * t157;
    const T t159 = t87 * t158;
    const T t160 = t156 + t159;
    const T t161 = t94 * t128;
    const T t162 = t74 * t92;
    const T t163 = t161 + t162;
    const T t164 = t78 * t90;
    const T t165 = t163 + t164;
    const T t166 = t104 * t158;
    const T t167 = t165 + t166;
    const T t168 = t116 * t128;
    const T t169 = t74 * t114;
    const T t170 = t168 + t169;
    const T t171 = t78 * t109;
    const T t172 = t170 + t171;
    const T t173 = t124 * t158;
    const T t174 = t172 + t173;
    const T t175 = t69 * t128;
    const T t176 = t71 * t74;
    const T t177 = t175 - t176;
    const T t178 = t30 * t56;
    const T t179 = t177 - t178;
    const T t180 = t44 * t82;
    const T t181 = K(0.5) * t180;
    const T t182 = t87 * t181;
    const T t183 = t179 + t182;
    const T t184 = t92 * t128;
    const T t185 = t74 * t94;
    const T t186 = t184 - t185;
    const T t187 = t30 * t90;
    const T t188 = t186 - t187;
    const T t189 = t104 * t181;
    const T t190 = t188 + t189;
    const T t191 = t114 * t128;
    const T t192 = t74 * t116;
    const T t193 = t191 - t192;
    const T t194 = t30 * t109;
    const T t195 = t193 - t194;
    const T t196 = t124 * t181;
    const T t197 = t195 + t196;
    const T t198 = t87 * t128;
    const T t199 = t56 * t135;
    const T t200 = t198 + t199;
    const T t201 = t71 * t158;
    const T t202 = t200 - t201;
    const T t203 = t69 * t181;
    const T t204 = t202 - t203;
    const T t205 = t104 * t128;
    const T t206 = t90 * t135;
    const T t207 = t205 + t206;
    const T t208 = t94 * t158;
    const T t209 = t207 - t208;
    const T t210 = t92 * t181;
    const T t211 = t209 - t210;
    const T t212 = t124 * t128;
    const T t213 = t109 * t135;
    const T t214 = t212 + t213;
    const T t215 = t116 * t158;
    const T t216 = t214 - t215;
    const T t217 = t114 * t181;
    const T t218 = t216 - t217;
    const T t219 = t74 * t87;
    const T t220 = t129 - t219;
    const T t221 = t130 + t220;
    const T t222 = t56 * t84;
    const T t223 = t221 + t222;
    const T t224 = K(0.5) / t10;
    const T t225 = t41 * t224;
    const T t226 = points[3] + points[0];
    const T t227 = K(0.5) * t226;
    const T t228 = t225 * t227;
    const T t229 = t33 * t224;
    const T t230 = points[4] + points[1];
    const T t231 = K(0.5) * t230;
    const T t232 = t229 * t231;
    const T t233 = t228 - t232;
    const T t234 = t28 * t224;
    const T t235 = points[5] + points[2];
    const T t236 = K(0.5) * t235;
    const T t237 = t234 * t236;
    const T t238 = t233 + t237;
    const T t239 = K(0.5) * t238;
    const T t240 = t87 * t239;
    const T t241 = t223 - t240;
    const T t242 = t225 * t231;
    const T t243 = t227 * t229;
    const T t244 = t242 + t243;
    const T t245 = t44 * t224;
    const T t246 = t236 * t245;
    const T t247 = t244 + t246;
    const T t248 = K(0.5) * t247;
    const T t249 = t56 * t248;
    const T t250 = t241 + t249;
    const T t251 = t136 - t250;
    const T t252 = t225 * t236;
    const T t253 = t227 * t234;
    const T t254 = t252 - t253;
    const T t255 = t231 * t245;
    const T t256 = t254 - t255;
    const T t257 = K(0.5) * t256;
    const T t258 = t71 * t257;
    const T t259 = t251 - t258;
    const T t260 = t69 * t158;
    const T t261 = t259 - t260;
    const T t262 = t229 * t236;
    const T t263 = t231 * t234;
    const T t264 = t262 + t263;
    const T t265 = t227 * t245;
    const T t266 = t264 - t265;
    const T t267 = K(0.5) * t266;
    const T t268 = t69 * t267;
    const T t269 = t261 - t268;
    const T t270 = t74 * t104;
    const T t271 = t138 - t270;
    const T t272 = t139 + t271;
    const T t273 = t84 * t90;
    const T t274 = t272 + t273;
    const T t275 = t104 * t239;
    const T t276 = t274 - t275;
    const T t277 = t90 * t248;
    const T t278 = t276 + t277;
    const T t279 = t143 - t278;
    const T t280 = t94 * t257;
    const T t281 = t279 - t280;
    const T t282 = t92 * t158;
    const T t283 = t281 - t282;
    const T t284 = t92 * t267;
    const T t285 = t283 - t284;
    const T t286 = t74 * t124;
    const T t287 = t145 - t286;
    const T t288 = t146 + t287;
    const T t289 = t84 * t109;
    const T t290 = t288 + t289;
    const T t291 = t124 * t239;
    const T t292 = t290 - t291;
    const T t293 = t109 * t248;
    const T t294 = t292 + t293;
    const T t295 = t150 - t294;
    const T t296 = t116 * t257;
    const T t297 = t295 - t296;
    const T t298 = t114 * t158;
    const T t299 = t297 - t298;
    const T t300 = t114 * t267;
    const T t301 = t299 - t300;
    const T t302 = t223 + t240;
    const T t303 = t249 - t302;
    const T t304 = t136 + t303;
    const T t305 = t258 + t304;
    const T t306 = t260 - t305;
    const T t307 = t268 - t306;
    const T t308 = t274 + t275;
    const T t309 = t277 - t308;
    const T t310 = t143 + t309;
    const T t311 = t280 + t310;
    const T t312 = t282 - t311;
    const T t313 = t284 - t312;
    const T t314 = t290 + t291;
    const T t315 = t293 - t314;
    const T t316 = t150 + t315;
    const T t317 = t296 + t316;
    const T t318 = t298 - t317;
    const T t319 = t300 - t318;
    const T t320 = t75 + t198;
    const T t321 = t79 - t320;
    const T t322 = t88 - t321;
    const T t323 = t56 * t239;
    const T t324 = t322 + t323;
    const T t325 = t87 * t248;
    const T t326 = t324 + t325;
    const T t327 = t199 + t326;
    const T t328 = t69 * t257;
    const T t329 = t327 - t328;
    const T t330 = t203 - t329;
    const T t331 = t71 * t267;
    const T t332 = t330 - t331;
    const T t333 = t96 + t205;
    const T t334 = t98 - t333;
    const T t335 = t105 - t334;
    const T t336 = t90 * t239;
    const T t337 = t335 + t336;
    const T t338 = t104 * t248;
    const T t339 = t337 + t338;
    const T t340 = t206 + t339;
    const T t341 = t92 * t257;
    const T t342 = t340 - t341;
    const T t343 = t210 - t342;
    const T t344 = t94 * t267;
    const T t345 = t343 - t344;
    const T t346 = t118 + t212;
    const T t347 = t120 - t346;
    const T t348 = t125 - t347;
    const T t349 = t109 * t239;
    const T t350 = t348 + t349;
    const T t351 = t124 * t248;
    const T t352 = t350 + t351;
    const T t353 = t213 + t352;
    const T t354 = t114 * t257;
    const T t355 = t353 - t354;
    const T t356 = t217 - t355;
    const T t357 = t116 * t267;
    const T t358 = t356 - t357;
    const T t359 = t322 - t323;
    const T t360 = t325 - t359;
    const T t361 = t199 - t360;
    const T t362 = t328 + t361;
    const T t363 = t203 - t362;
    const T t364 = t331 + t363;
    const T t365 = t335 - t336;
    const T t366 = t338 - t365;
    const T t367 = t206 - t366;
    const T t368 = t341 + t367;
    const T t369 = t210 - t368;
    const T t370 = t344 + t369;
    const T t371 = t348 - t349;
    const T t372 = t351 - t371;
    const T t373 = t213 - t372;
    const T t374 = t354 + t373;
    const T t375 = t217 - t374;
    const T t376 = t357 + t375;
    const T t377 = t219 - t222;
    const T t378 = t260 - t377;
    const T t379 = t71 * t181;
    const T t380 = t378 - t379;
    const T t381 = t270 - t273;
    const T t382 = t282 - t381;
    const T t383 = t94 * t181;
    const T t384 = t382 - t383;
    const T t385 = t286 - t289;
    const T t386 = t298 - t385;
    const T t387 = t116 * t181;
    const T t388 = t386 - t387;
    const T t389 = t175 - t178;
    const T t390 = t78 * t87;
    const T t391 = t389 + t390;
    const T t392 = t69 * t84;
    const T t393 = t391 + t392;
    const T t394 = t71 * t239;
    const T t395 = t393 + t394;
    const T t396 = t69 * t248;
    const T t397 = t395 + t396;
    const T t398 = t87 * t257;
    const T t399 = t397 + t398;
    const T t400 = t56 * t158;
    const T t401 = t399 - t400;
    const T t402 = t182 + t401;
    const T t403 = t56 * t267;
    const T t404 = t402 - t403;
    const T t405 = t184 - t187;
    const T t406 = t78 * t104;
    const T t407 = t405 + t406;
    const T t408 = t84 * t92;
    const T t409 = t407 + t408;
    const T t410 = t94 * t239;
    const T t411 = t409 + t410;
    const T t412 = t92 * t248;
    const T t413 = t411 + t412;
    const T t414 = t104 * t257;
    const T t415 = t413 + t414;
    const T t416 = t90 * t158;
    const T t417 = t415 - t416;
    const T t418 = t189 + t417;
    const T t419 = t90 * t267;
    const T t420 = t418 - t419;
    const T t421 = t191 - t194;
    const T t422 = t78 * t124;
    const T t423 = t421 + t422;
    const T t424 = t84 * t114;
    const T t425 = t423 + t424;
    const T t426 = t116 * t239;
    const T t427 = t425 + t426;
    const T t428 = t114 * t248;
    const T t429 = t427 + t428;
    const T t430 = t124 * t257;
    const T t431 = t429 + t430;
    const T t432 = t109 * t158;
    const T t433 = t431 - t432;
    const T t434 = t196 + t433;
    const T t435 = t109 * t267;
    const T t436 = t434 - t435;
    const T t437 = t393 - t394;
    const T t438 = t396 - t437;
    const T t439 = t398 + t438;
    const T t440 = t400 + t439;
    const T t441 = t182 - t440;
    const T t442 = t403 + t441;
    const T t443 = t409 - t410;
    const T t444 = t412 - t443;
    const T t445 = t414 + t444;
    const T t446 = t416 + t445;
    const T t447 = t189 - t446;
    const T t448 = t419 + t447;
    const T t449 = t425 - t426;
    const T t450 = t428 - t449;
    const T t451 = t430 + t450;
    const T t452 = t432 + t451;
    const T t453 = t196 - t452;
    const T t454 = t435 + t453;
    const T t455 = t71 * t84;
    const T t456 = t30 * t87;
    const T t457 = t455 + t456;
    const T t458 = t69 * t135;
    const T t459 = t457 + t458;
    const T t460 = t56 * t181;
    const T t461 = t459 + t460;
    const T t462 = t84 * t94;
    const T t463 = t30 * t104;
    const T t464 = t462 + t463;
    const T t465 = t92 * t135;
    const T t466 = t464 + t465;
    const T t467 = t90 * t181;
    const T t468 = t466 + t467;
    const T t469 = t84 * t116;
    const T t470 = t30 * t124;
    const T t471 = t469 + t470;
    const T t472 = t114 * t135;
    const T t473 = t471 + t472;
    const T t474 = t109 * t181;
    const T t475 = t473 + t474;
    const T t476 = t390 + t392;
    const T t477 = t71 * t135;
    const T t478 = t476 - t477;
    const T t479 = t400 - t478;
    const T t480 = t406 + t408;
    const T t481 = t94 * t135;
    const T t482 = t480 - t481;
    const T t483 = t416 - t482;
    const T t484 = t422 + t424;
    const T t485 = t116 * t135;
    const T t486 = t484 - t485;
    const T t487 = t432 - t486;
    const T t488 = t153 + t456;
    const T t489 = t155 + t488;
    const T t490 = t69 * t239;
    const T t491 = t489 + t490;
    const T t492 = t71 * t248;
    const T t493 = t491 - t492;
    const T t494 = t458 + t493;
    const T t495 = t56 * t257;
    const T t496 = t494 + t495;
    const T t497 = t159 + t496;
    const T t498 = t460 + t497;
    const T t499 = t87 * t267;
    const T t500 = t498 + t499;
    const T t501 = t162 + t463;
    const T t502 = t164 + t501;
    const T t503 = t92 * t239;
    const T t504 = t502 + t503;
    const T t505 = t94 * t248;
    const T t506 = t504 - t505;
    const T t507 = t465 + t506;
    const T t508 = t90 * t257;
    const T t509 = t507 + t508;
    const T t510 = t166 + t509;
    const T t511 = t467 + t510;
    const T t512 = t104 * t267;
    const T t513 = t511 + t512;
    const T t514 = t169 + t470;
    const T t515 = t171 + t514;
    const T t516 = t114 * t239;
    const T t517 = t515 + t516;
    const T t518 = t116 * t248;
    const T t519 = t517 - t518;
    const T t520 = t472 + t519;
    const T t521 = t109 * t257;
    const T t522 = t520 + t521;
    const T t523 = t173 + t522;
    const T t524 = t474 + t523;
    const T t525 = t124 * t267;
    const T t526 = t524 + t525;
    const T t527 = t489 - t490;
    const T t528 = t492 + t527;
    const T t529 = t458 + t528;
    const T t530 = t495 - t529;
    const T t531 = t159 - t530;
    const T t532 = t460 + t531;
    const T t533 = t499 - t532;
    const T t534 = t502 - t503;
    const T t535 = t505 + t534;
    const T t536 = t465 + t535;
    const T t537 = t508 - t536;
    const T t538 = t166 - t537;
    const T t539 = t467 + t538;
    const T t540 = t512 - t539;
    const T t541 = t515 - t516;
    const T t542 = t518 + t541;
    const T t543 = t472 + t542;
    const T t544 = t521 - t543;
    const T t545 = t173 - t544;
    const T t546 = t474 + t545;
    const T t547 = t525 - t546;
    out[0] = -t89;
    out[1] = t106;
    out[2] = t126;
    out[3] = t89;
    out[4] = -t106;
    out[5] = -t126;
    out[6] = -t137;
    out[7] = t144;
    out[8] = t151;
    out[9] = t137;
    out[10] = -t144;
    out[11] = -t151;
    out[12] = -t160;
    out[13] = t167;
    out[14] = t174;
    out[15] = t160;
    out[16] = -t167;
    out[17] = -t174;
    out[18] = -t183;
    out[19] = t190;
    out[20] = t197;
    out[21] = t183;
    out[22] = -t190;
    out[23] = -t197;
    out[24] = t204;
    out[25] = -t211;
    out[26] = -t218;
    out[27] = -t204;
    out[28] = t211;
    out[29] = t218;
    out[30] = t269;
    out[31] = -t285;
    out[32] = -t301;
    out[33] = t307;
    out[34] = -t313;
    out[35] = -t319;
    out[36] = -t332;
    out[37] = t345;
    out[38] = t358;
    out[39] = -t364;
    out[40] = t370;
    out[41] = t376;
    out[42] = -t380;
    out[43] = t384;
    out[44] = t388;
    out[45] = t380;
    out[46] = -t384;
    out[47] = -t388;
    out[48] = t404;
    out[49] = -t420;
    out[50] = -t436;
    out[51] = t442;
    out[52] = -t448;
    out[53] = -t454;
    out[54] = -t461;
    out[55] = t468;
    out[56] = t475;
    out[57] = t461;
    out[58] = -t468;
    out[59] = -t475;
    out[60] = t479;
    out[61] = -t483;
    out[62] = -t487;
    out[63] = -t479;
    out[64] = t483;
    out[65] = t487;
    out[66] = t500;
    out[67] = -t513;
    out[68] = -t526;
    out[69] = -t533;
    out[70] = t540;
    out[71] = t547;
}

CGA_EXPORT int cga_cooperative_point_pair_analytic_jacobian(const double *restrict points /* 6 */, const double *restrict chart /* 1 */, double *restrict out /* 72 */)
{
    cga_cooperative_point_pair_analytic_jacobian_body(points, chart, out);
    return cga_not_finite(points, 6) || cga_not_finite(chart, 1);
}

CGA_EXPORT int cga_cooperative_point_pair_analytic_jacobian_batch(int64_t n, const double *restrict points /* 6 */, const double *restrict chart /* 1 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_point_pair_analytic_jacobian(points + k * 6, chart + k * 1, out + k * 72);
    return bad;
}

/* J_G = -2 ~V dV by the points, rows e12 e13 e23 e0i e1i e2i e3i, in the primitive's own frame (paper A, eq. 30). From cga_codegen.kernels.similarity.geometric_jacobian.
   45 mul, 27 add, 17 div, 2 sqrt. */
static inline void cga_cooperative_point_pair_geometric_jacobian_body(const T *restrict points, const T *restrict chart, T *restrict out)
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
    const T t32 = t31 / t10;
    const T t33 = t17 / t20;
    const T t34 = chart[0] * t33;
    const T t35 = t26 * t34;
    const T t36 = t14 / t20;
    const T t37 = chart[0] * t36;
    const T t38 = t1 * t37;
    const T t39 = t35 + t38;
    const T t40 = t23 * t39;
    const T t41 = t26 * t37;
    const T t42 = t1 * t34;
    const T t43 = t41 - t42;
    const T t44 = t27 * t43;
    const T t45 = t40 + t44;
    const T t46 = K(2.0) * t45;
    const T t47 = t46 / t10;
    const T t48 = t23 * t43;
    const T t49 = t27 * t39;
    const T t50 = t48 - t49;
    const T t51 = K(2.0) * t50;
    const T t52 = t51 / t10;
    const T t53 = t23 * t27;
    const T t54 = t39 * t43;
    const T t55 = t53 - t54;
    const T t56 = K(2.0) * t55;
    const T t57 = chart[0] * t56;
    const T t58 = K(2.0) * t57;
    const T t59 = t58 / t19;
    const T t60 = t32 * t59;
    const T t61 = chart[0] * t46;
    const T t62 = K(2.0) * t61;
    const T t63 = t62 / t19;
    const T t64 = t48 + t49;
    const T t65 = K(2.0) * t64;
    const T t66 = t65 / t10;
    const T t67 = t63 * t66;
    const T t68 = t60 - t67;
    const T t69 = t47 * t59;
    const T t70 = t56 / t10;
    const T t71 = t63 * t70;
    const T t72 = t69 - t71;
    const T t73 = t52 * t59;
    const T t74 = t39 * t39;
    const T t75 = t24 + t74;
    const T t76 = K(2.0) * t75;
    const T t77 = K(1.0) - t76;
    const T t78 = t77 / t10;
    const T t79 = t63 * t78;
    const T t80 = t73 + t79;
    const T t81 = t40 - t44;
    const T t82 = K(2.0) * t81;
    const T t83 = t82 / t10;
    const T t84 = t28 + t74;
    const T t85 = K(2.0) * t84;
    const T t86 = K(1.0) - t85;
    const T t87 = t86 / t10;
    const T t88 = t53 + t54;
    const T t89 = K(2.0) * t88;
    const T t90 = t89 / t10;
    out[0] = t32;
    out[1] = -t47;
    out[2] = t52;
    out[3] = -t32;
    out[4] = t47;
    out[5] = -t52;
    out[6] = t68;
    out[7] = -t72;
    out[8] = t80;
    out[9] = -t68;
    out[10] = t72;
    out[11] = -t80;
    out[12] = t66;
    out[13] = -t70;
    out[14] = -t78;
    out[15] = -t66;
    out[16] = t70;
    out[17] = t78;
    out[18] = -t83;
    out[19] = t87;
    out[20] = t90;
    out[21] = t83;
    out[22] = -t87;
    out[23] = -t90;
    out[24] = t32;
    out[25] = -t47;
    out[26] = t52;
    out[27] = t32;
    out[28] = -t47;
    out[29] = t52;
    out[30] = -t83;
    out[31] = t87;
    out[32] = t90;
    out[33] = -t83;
    out[34] = t87;
    out[35] = t90;
    out[36] = -t66;
    out[37] = t70;
    out[38] = t78;
    out[39] = -t66;
    out[40] = t70;
    out[41] = t78;
}

CGA_EXPORT int cga_cooperative_point_pair_geometric_jacobian(const double *restrict points /* 6 */, const double *restrict chart /* 1 */, double *restrict out /* 42 */)
{
    cga_cooperative_point_pair_geometric_jacobian_body(points, chart, out);
    return cga_not_finite(points, 6) || cga_not_finite(chart, 1);
}

CGA_EXPORT int cga_cooperative_point_pair_geometric_jacobian_batch(int64_t n, const double *restrict points /* 6 */, const double *restrict chart /* 1 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_point_pair_geometric_jacobian(points + k * 6, chart + k * 1, out + k * 42);
    return bad;
}

/* The geometric Jacobian without the motions that leave the primitive where it is: rows of the controllable blades, others zero. From cga_codegen.kernels.similarity.horizontal_jacobian.
   35 mul, 24 add, 15 div, 2 sqrt. */
static inline void cga_cooperative_point_pair_horizontal_jacobian_body(const T *restrict points, const T *restrict chart, T *restrict out)
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
    const T t32 = t31 / t10;
    const T t33 = t17 / t20;
    const T t34 = chart[0] * t33;
    const T t35 = t26 * t34;
    const T t36 = t14 / t20;
    const T t37 = chart[0] * t36;
    const T t38 = t1 * t37;
    const T t39 = t35 + t38;
    const T t40 = t23 * t39;
    const T t41 = t26 * t37;
    const T t42 = t1 * t34;
    const T t43 = t41 - t42;
    const T t44 = t27 * t43;
    const T t45 = t40 + t44;
    const T t46 = K(2.0) * t45;
    const T t47 = t46 / t10;
    const T t48 = t23 * t43;
    const T t49 = t27 * t39;
    const T t50 = t48 - t49;
    const T t51 = K(2.0) * t50;
    const T t52 = t51 / t10;
    const T t53 = t48 + t49;
    const T t54 = K(2.0) * t53;
    const T t55 = t54 / t10;
    const T t56 = t23 * t27;
    const T t57 = t39 * t43;
    const T t58 = t56 - t57;
    const T t59 = K(2.0) * t58;
    const T t60 = t59 / t10;
    const T t61 = t39 * t39;
    const T t62 = t24 + t61;
    const T t63 = K(2.0) * t62;
    const T t64 = K(1.0) - t63;
    const T t65 = t64 / t10;
    const T t66 = t40 - t44;
    const T t67 = K(2.0) * t66;
    const T t68 = t67 / t10;
    const T t69 = t28 + t61;
    const T t70 = K(2.0) * t69;
    const T t71 = K(1.0) - t70;
    const T t72 = t71 / t10;
    const T t73 = t56 + t57;
    const T t74 = K(2.0) * t73;
    const T t75 = t74 / t10;
    out[0] = t32;
    out[1] = -t47;
    out[2] = t52;
    out[3] = -t32;
    out[4] = t47;
    out[5] = -t52;
    out[6] = K(0.0);
    out[7] = K(0.0);
    out[8] = K(0.0);
    out[9] = K(0.0);
    out[10] = K(0.0);
    out[11] = K(0.0);
    out[12] = t55;
    out[13] = -t60;
    out[14] = -t65;
    out[15] = -t55;
    out[16] = t60;
    out[17] = t65;
    out[18] = -t68;
    out[19] = t72;
    out[20] = t75;
    out[21] = t68;
    out[22] = -t72;
    out[23] = -t75;
    out[24] = t32;
    out[25] = -t47;
    out[26] = t52;
    out[27] = t32;
    out[28] = -t47;
    out[29] = t52;
    out[30] = -t68;
    out[31] = t72;
    out[32] = t75;
    out[33] = -t68;
    out[34] = t72;
    out[35] = t75;
    out[36] = -t55;
    out[37] = t60;
    out[38] = t65;
    out[39] = -t55;
    out[40] = t60;
    out[41] = t65;
}

CGA_EXPORT int cga_cooperative_point_pair_horizontal_jacobian(const double *restrict points /* 6 */, const double *restrict chart /* 1 */, double *restrict out /* 42 */)
{
    cga_cooperative_point_pair_horizontal_jacobian_body(points, chart, out);
    return cga_not_finite(points, 6) || cga_not_finite(chart, 1);
}

CGA_EXPORT int cga_cooperative_point_pair_horizontal_jacobian_batch(int64_t n, const double *restrict points /* 6 */, const double *restrict chart /* 1 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_point_pair_horizontal_jacobian(points + k * 6, chart + k * 1, out + k * 42);
    return bad;
}

/* Time derivative of `geometric_jacobian` where the points move with `velocities` (m/s). From cga_codegen.kernels.similarity.geometric_jacobian_derivative.
   122 mul, 74 add, 53 div, 2 sqrt. */
static inline void cga_cooperative_point_pair_geometric_jacobian_derivative_body(const T *restrict points, const T *restrict chart, const T *restrict velocities, T *restrict out)
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
    const T t75 = t74 / t10;
    const T t76 = t23 * t23;
    const T t77 = t69 * t69;
    const T t78 = t76 + t77;
    const T t79 = K(2.0) * t78;
    const T t80 = K(1.0) - t79;
    const T t81 = t80 / t10;
    const T t82 = t81 / t10;
    const T t83 = t39 * t82;
    const T t84 = t75 + t83;
    const T t85 = t57 / t20;
    const T t86 = t17 / t20;
    const T t87 = t86 / t20;
    const T t88 = t61 * t87;
    const T t89 = t85 - t88;
    const T t90 = chart[0] * t89;
    const T t91 = t68 * t90;
    const T t92 = t50 / t20;
    const T t93 = t14 / t20;
    const T t94 = t93 / t20;
    const T t95 = t61 * t94;
    const T t96 = t92 - t95;
    const T t97 = chart[0] * t96;
    const T t98 = t1 * t97;
    const T t99 = t91 + t98;
    const T t100 = t23 * t99;
    const T t101 = chart[0] * t86;
    const T t102 = t68 * t101;
    const T t103 = chart[0] * t93;
    const T t104 = t1 * t103;
    const T t105 = t102 + t104;
    const T t106 = t65 * t105;
    const T t107 = t100 + t106;
    const T t108 = t68 * t97;
    const T t109 = t1 * t90;
    const T t110 = t108 - t109;
    const T t111 = t69 * t110;
    const T t112 = t68 * t103;
    const T t113 = t1 * t101;
    const T t114 = t112 - t113;
    const T t115 = t71 * t114;
    const T t116 = t111 + t115;
    const T t117 = t107 + t116;
    const T t118 = K(2.0) * t117;
    const T t119 = t118 / t10;
    const T t120 = t23 * t105;
    const T t121 = t69 * t114;
    const T t122 = t120 + t121;
    const T t123 = K(2.0) * t122;
    const T t124 = t123 / t10;
    const T t125 = t124 / t10;
    const T t126 = t39 * t125;
    const T t127 = t119 - t126;
    const T t128 = t23 * t110;
    const T t129 = t65 * t114;
    const T t130 = t128 + t129;
    const T t131 = t69 * t99;
    const T t132 = t71 * t105;
    const T t133 = t131 + t132;
    const T t134 = t130 - t133;
    const T t135 = K(2.0) * t134;
    const T t136 = t135 / t10;
    const T t137 = t23 * t114;
    const T t138 = t69 * t105;
    const T t139 = t137 - t138;
    const T t140 = K(2.0) * t139;
    const T t141 = t140 / t10;
    const T t142 = t141 / t10;
    const T t143 = t39 * t142;
    const T t144 = t136 - t143;
    const T t145 = t65 * t69;
    const T t146 = t23 * t71;
    const T t147 = t145 + t146;
    const T t148 = t105 * t110;
    const T t149 = t99 * t114;
    const T t150 = t148 + t149;
    const T t151 = t147 - t150;
    const T t152 = K(2.0) * t151;
    const T t153 = chart[0] * t152;
    const T t154 = K(2.0) * t153;
    const T t155 = t154 / t19;
    const T t156 = t23 * t69;
    const T t157 = t105 * t114;
    const T t158 = t156 - t157;
    const T t159 = K(2.0) * t158;
    const T t160 = chart[0] * t159;
    const T t161 = K(2.0) * t160;
    const T t162 = t161 / t19;
    const T t163 = t162 / t19;
    const T t164 = t59 * t163;
    const T t165 = t155 - t164;
    const T t166 = t81 * t165;
    const T t167 = t84 * t162;
    const T t168 = t166 - t167;
    const T t169 = t137 + t138;
    const T t170 = K(2.0) * t169;
    const T t171 = t170 / t10;
    const T t172 = chart[0] * t118;
    const T t173 = K(2.0) * t172;
    const T t174 = t173 / t19;
    const T t175 = chart[0] * t123;
    const T t176 = K(2.0) * t175;
    const T t177 = t176 / t19;
    const T t178 = t177 / t19;
    const T t179 = t59 * t178;
    const T t180 = t174 - t179;
    const T t181 = t171 * t180;
    const T t182 = t130 + t133;
    const T t183 = K(2.0) * t182;
    const T t184 = t183 / t10;
    const T t185 = t171 / t10;
    const T t186 = t39 * t185;
    const T t187 = t184 - t186;
    const T t188 = t177 * t187;
    const T t189 = t181 + t188;
    const T t190 = t168 - t189;
    const T t191 = t124 * t165;
    const T t192 = t127 * t162;
    const T t193 = t191 + t192;
    const T t194 = t159 / t10;
    const T t195 = t180 * t194;
    const T t196 = t152 / t10;
    const T t197 = t194 / t10;
    const T t198 = t39 * t197;
    const T t199 = t196 - t198;
    const T t200 = t177 * t199;
    const T t201 = t195 + t200;
    const T t202 = t193 - t201;
    const T t203 = t141 * t165;
    const T t204 = t144 * t162;
    const T t205 = t203 + t204;
    const T t206 = t105 * t105;
    const T t207 = t76 + t206;
    const T t208 = K(2.0) * t207;
    const T t209 = K(1.0) - t208;
    const T t210 = t209 / t10;
    const T t211 = t180 * t210;
    const T t212 = K(2.0) * t105;
    const T t213 = t99 * t212;
    const T t214 = t66 + t213;
    const T t215 = K(2.0) * t214;
    const T t216 = t215 / t10;
    const T t217 = t210 / t10;
    const T t218 = t39 * t217;
    const T t219 = t216 + t218;
    const T t220 = t177 * t219;
    const T t221 = t211 - t220;
    const T t222 = t205 + t221;
    const T t223 = t107 - t116;
    const T t224 = K(2.0) * t223;
    const T t225 = t224 / t10;
    const T t226 = t120 - t121;
    const T t227 = K(2.0) * t226;
    const T t228 = t227 / t10;
    const T t229 = t228 / t10;
    const T t230 = t39 * t229;
    const T t231 = t225 - t230;
    const T t232 = t72 + t213;
    const T t233 = K(2.0) * t232;
    const T t234 = t233 / t10;
    const T t235 = t77 + t206;
    const T t236 = K(2.0) * t235;
    const T t237 = K(1.0) - t236;
    const T t238 = t237 / t10;
    const T t239 = t238 / t10;
    const T t240 = t39 * t239;
    const T t241 = t234 + t240;
    const T t242 = t147 + t150;
    const T t243 = K(2.0) * t242;
    const T t244 = t243 / t10;
    const T t245 = t156 + t157;
    const T t246 = K(2.0) * t245;
    const T t247 = t246 / t10;
    const T t248 = t247 / t10;
    const T t249 = t39 * t248;
    const T t250 = t244 - t249;
    out[0] = -t84;
    out[1] = -t127;
    out[2] = t144;
    out[3] = t84;
    out[4] = t127;
    out[5] = -t144;
    out[6] = t190;
    out[7] = -t202;
    out[8] = t222;
    out[9] = -t190;
    out[10] = t202;
    out[11] = -t222;
    out[12] = t187;
    out[13] = -t199;
    out[14] = t219;
    out[15] = -t187;
    out[16] = t199;
    out[17] = -t219;
    out[18] = -t231;
    out[19] = -t241;
    out[20] = t250;
    out[21] = t231;
    out[22] = t241;
    out[23] = -t250;
    out[24] = -t84;
    out[25] = -t127;
    out[26] = t144;
    out[27] = -t84;
    out[28] = -t127;
    out[29] = t144;
    out[30] = -t231;
    out[31] = -t241;
    out[32] = t250;
    out[33] = -t231;
    out[34] = -t241;
    out[35] = t250;
    out[36] = -t187;
    out[37] = t199;
    out[38] = -t219;
    out[39] = -t187;
    out[40] = t199;
    out[41] = -t219;
}

CGA_EXPORT int cga_cooperative_point_pair_geometric_jacobian_derivative(const double *restrict points /* 6 */, const double *restrict chart /* 1 */, const double *restrict velocities /* 6 */, double *restrict out /* 42 */)
{
    cga_cooperative_point_pair_geometric_jacobian_derivative_body(points, chart, velocities, out);
    return cga_not_finite(points, 6) || cga_not_finite(chart, 1) || cga_not_finite(velocities, 6);
}

CGA_EXPORT int cga_cooperative_point_pair_geometric_jacobian_derivative_batch(int64_t n, const double *restrict points /* 6 */, const double *restrict chart /* 1 */, const double *restrict velocities /* 6 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_point_pair_geometric_jacobian_derivative(points + k * 6, chart + k * 1, velocities + k * 6, out + k * 42);
    return bad;
}

/* Time derivative of `horizontal_jacobian` where the points move with `velocities` (m/s). From cga_codegen.kernels.similarity.horizontal_jacobian_derivative.
   100 mul, 63 add, 47 div, 2 sqrt. */
static inline void cga_cooperative_point_pair_horizontal_jacobian_derivative_body(const T *restrict points, const T *restrict chart, const T *restrict velocities, T *restrict out)
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
    const T t75 = t74 / t10;
    const T t76 = t23 * t23;
    const T t77 = t69 * t69;
    const T t78 = t76 + t77;
    const T t79 = K(2.0) * t78;
    const T t80 = K(1.0) - t79;
    const T t81 = t80 / t10;
    const T t82 = t81 / t10;
    const T t83 = t39 * t82;
    const T t84 = t75 + t83;
    const T t85 = t57 / t20;
    const T t86 = t17 / t20;
    const T t87 = t86 / t20;
    const T t88 = t61 * t87;
    const T t89 = t85 - t88;
    const T t90 = chart[0] * t89;
    const T t91 = t68 * t90;
    const T t92 = t50 / t20;
    const T t93 = t14 / t20;
    const T t94 = t93 / t20;
    const T t95 = t61 * t94;
    const T t96 = t92 - t95;
    const T t97 = chart[0] * t96;
    const T t98 = t1 * t97;
    const T t99 = t91 + t98;
    const T t100 = t23 * t99;
    const T t101 = chart[0] * t86;
    const T t102 = t68 * t101;
    const T t103 = chart[0] * t93;
    const T t104 = t1 * t103;
    const T t105 = t102 + t104;
    const T t106 = t65 * t105;
    const T t107 = t100 + t106;
    const T t108 = t68 * t97;
    const T t109 = t1 * t90;
    const T t110 = t108 - t109;
    const T t111 = t69 * t110;
    const T t112 = t68 * t103;
    const T t113 = t1 * t101;
    const T t114 = t112 - t113;
    const T t115 = t71 * t114;
    const T t116 = t111 + t115;
    const T t117 = t107 + t116;
    const T t118 = K(2.0) * t117;
    const T t119 = t118 / t10;
    const T t120 = t23 * t105;
    const T t121 = t69 * t114;
    const T t122 = t120 + t121;
    const T t123 = K(2.0) * t122;
    const T t124 = t123 / t10;
    const T t125 = t124 / t10;
    const T t126 = t39 * t125;
    const T t127 = t119 - t126;
    const T t128 = t23 * t110;
    const T t129 = t65 * t114;
    const T t130 = t128 + t129;
    const T t131 = t69 * t99;
    const T t132 = t71 * t105;
    const T t133 = t131 + t132;
    const T t134 = t130 - t133;
    const T t135 = K(2.0) * t134;
    const T t136 = t135 / t10;
    const T t137 = t23 * t114;
    const T t138 = t69 * t105;
    const T t139 = t137 - t138;
    const T t140 = K(2.0) * t139;
    const T t141 = t140 / t10;
    const T t142 = t141 / t10;
    const T t143 = t39 * t142;
    const T t144 = t136 - t143;
    const T t145 = t130 + t133;
    const T t146 = K(2.0) * t145;
    const T t147 = t146 / t10;
    const T t148 = t137 + t138;
    const T t149 = K(2.0) * t148;
    const T t150 = t149 / t10;
    const T t151 = t150 / t10;
    const T t152 = t39 * t151;
    const T t153 = t147 - t152;
    const T t154 = t65 * t69;
    const T t155 = t23 * t71;
    const T t156 = t154 + t155;
    const T t157 = t105 * t110;
    const T t158 = t99 * t114;
    const T t159 = t157 + t158;
    const T t160 = t156 - t159;
    const T t161 = K(2.0) * t160;
    const T t162 = t161 / t10;
    const T t163 = t23 * t69;
    const T t164 = t105 * t114;
    const T t165 = t163 - t164;
    const T t166 = K(2.0) * t165;
    const T t167 = t166 / t10;
    const T t168 = t167 / t10;
    const T t169 = t39 * t168;
    const T t170 = t162 - t169;
    const T t171 = K(2.0) * t105;
    const T t172 = t99 * t171;
    const T t173 = t66 + t172;
    const T t174 = K(2.0) * t173;
    const T t175 = t174 / t10;
    const T t176 = t105 * t105;
    const T t177 = t76 + t176;
    const T t178 = K(2.0) * t177;
    const T t179 = K(1.0) - t178;
    const T t180 = t179 / t10;
    const T t181 = t180 / t10;
    const T t182 = t39 * t181;
    const T t183 = t175 + t182;
    const T t184 = t107 - t116;
    const T t185 = K(2.0) * t184;
    const T t186 = t185 / t10;
    const T t187 = t120 - t121;
    const T t188 = K(2.0) * t187;
    const T t189 = t188 / t10;
    const T t190 = t189 / t10;
    const T t191 = t39 * t190;
    const T t192 = t186 - t191;
    const T t193 = t72 + t172;
    const T t194 = K(2.0) * t193;
    const T t195 = t194 / t10;
    const T t196 = t77 + t176;
    const T t197 = K(2.0) * t196;
    const T t198 = K(1.0) - t197;
    const T t199 = t198 / t10;
    const T t200 = t199 / t10;
    const T t201 = t39 * t200;
    const T t202 = t195 + t201;
    const T t203 = t156 + t159;
    const T t204 = K(2.0) * t203;
    const T t205 = t204 / t10;
    const T t206 = t163 + t164;
    const T t207 = K(2.0) * t206;
    const T t208 = t207 / t10;
    const T t209 = t208 / t10;
    const T t210 = t39 * t209;
    const T t211 = t205 - t210;
    out[0] = -t84;
    out[1] = -t127;
    out[2] = t144;
    out[3] = t84;
    out[4] = t127;
    out[5] = -t144;
    out[6] = K(0.0);
    out[7] = K(0.0);
    out[8] = K(0.0);
    out[9] = K(0.0);
    out[10] = K(0.0);
    out[11] = K(0.0);
    out[12] = t153;
    out[13] = -t170;
    out[14] = t183;
    out[15] = -t153;
    out[16] = t170;
    out[17] = -t183;
    out[18] = -t192;
    out[19] = -t202;
    out[20] = t211;
    out[21] = t192;
    out[22] = t202;
    out[23] = -t211;
    out[24] = -t84;
    out[25] = -t127;
    out[26] = t144;
    out[27] = -t84;
    out[28] = -t127;
    out[29] = t144;
    out[30] = -t192;
    out[31] = -t202;
    out[32] = t211;
    out[33] = -t192;
    out[34] = -t202;
    out[35] = t211;
    out[36] = -t153;
    out[37] = t170;
    out[38] = -t183;
    out[39] = -t153;
    out[40] = t170;
    out[41] = -t183;
}

CGA_EXPORT int cga_cooperative_point_pair_horizontal_jacobian_derivative(const double *restrict points /* 6 */, const double *restrict chart /* 1 */, const double *restrict velocities /* 6 */, double *restrict out /* 42 */)
{
    cga_cooperative_point_pair_horizontal_jacobian_derivative_body(points, chart, velocities, out);
    return cga_not_finite(points, 6) || cga_not_finite(chart, 1) || cga_not_finite(velocities, 6);
}

CGA_EXPORT int cga_cooperative_point_pair_horizontal_jacobian_derivative_batch(int64_t n, const double *restrict points /* 6 */, const double *restrict chart /* 1 */, const double *restrict velocities /* 6 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_point_pair_horizontal_jacobian_derivative(points + k * 6, chart + k * 1, velocities + k * 6, out + k * 42);
    return bad;
}

/* How far a primitive is from degenerate: |a| (m) of two points, the sine |a x b|/(|a||b|) of three, |det[a, b, d]|/(|a||b||d|) of From cga_codegen.kernels.primitives.degeneracy.
   3 mul, 6 add, 0 div, 1 sqrt. */
static inline void cga_cooperative_point_pair_degeneracy_body(const T *restrict points, T *restrict out)
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

CGA_EXPORT int cga_cooperative_point_pair_degeneracy(const double *restrict points /* 6 */, double *restrict out /* 1 */)
{
    cga_cooperative_point_pair_degeneracy_body(points, out);
    return cga_not_finite(points, 6);
}

CGA_EXPORT int cga_cooperative_point_pair_degeneracy_batch(int64_t n, const double *restrict points /* 6 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_point_pair_degeneracy(points + k * 6, out + k * 1);
    return bad;
}

/* What is looked at before the rest is trusted: `degeneracy`, the cosine between direction and reference direction (0 without one), and From cga_codegen.kernels.primitives.guard.
   3 mul, 6 add, 1 div, 1 sqrt. */
static inline void cga_cooperative_point_pair_guard_body(const T *restrict points, T *restrict out)
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

CGA_EXPORT int cga_cooperative_point_pair_guard(const double *restrict points /* 6 */, double *restrict out /* 3 */)
{
    cga_cooperative_point_pair_guard_body(points, out);
    return cga_not_finite(points, 6);
}

CGA_EXPORT int cga_cooperative_point_pair_guard_batch(int64_t n, const double *restrict points /* 6 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_point_pair_guard(points + k * 6, out + k * 3);
    return bad;
}

/* Derivative of `degeneracy` by the points. From cga_codegen.kernels.primitives.degeneracy_gradient.
   3 mul, 6 add, 3 div, 1 sqrt. */
static inline void cga_cooperative_point_pair_degeneracy_gradient_body(const T *restrict points, T *restrict out)
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

CGA_EXPORT int cga_cooperative_point_pair_degeneracy_gradient(const double *restrict points /* 6 */, double *restrict out /* 6 */)
{
    cga_cooperative_point_pair_degeneracy_gradient_body(points, out);
    return cga_not_finite(points, 6);
}

CGA_EXPORT int cga_cooperative_point_pair_degeneracy_gradient_batch(int64_t n, const double *restrict points /* 6 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_point_pair_degeneracy_gradient(points + k * 6, out + k * 6);
    return bad;
}
