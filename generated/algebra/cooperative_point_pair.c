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
   50 mul, 25 add, 8 div, 3 sqrt. */
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
    const T t17 = chart[0] * t16;
    const T t18 = K(1.0) + t17;
    const T t19 = t18 * t18;
    const T t20 = t0 / t8;
    const T t21 = t20 * t20;
    const T t22 = t5 / t8;
    const T t23 = t22 * t22;
    const T t24 = t21 + t23;
    const T t25 = t19 + t24;
    const T t26 = K(0.5) * t25;
    const T t27 = chart[0] * t26;
    const T t28 = ROOT(t25);
    const T t29 = t27 / t28;
    const T t30 = chart[0] * t29;
    const T t31 = t15 * t30;
    const T t32 = K(1.0) - chart[0];
    const T t33 = K(0.5) * t32;
    const T t34 = t22 / t28;
    const T t35 = chart[0] * t34;
    const T t36 = t33 * t35;
    const T t37 = t31 - t36;
    const T t38 = t13 * t37;
    const T t39 = t20 / t28;
    const T t40 = chart[0] * t39;
    const T t41 = t15 * t40;
    const T t42 = t13 * t41;
    const T t43 = t33 * t40;
    const T t44 = t13 * t43;
    const T t45 = t15 * t35;
    const T t46 = t30 * t33;
    const T t47 = t45 + t46;
    const T t48 = t13 * t47;
    const T t49 = t10 - t11;
    const T t50 = K(0.5) * t49;
    const T t51 = t37 * t50;
    const T t52 = K(0.5) / t10;
    const T t53 = t37 * t52;
    const T t54 = points[3] + points[0];
    const T t55 = K(0.5) * t54;
    const T t56 = t53 * t55;
    const T t57 = t41 * t52;
    const T t58 = points[4] + points[1];
    const T t59 = K(0.5) * t58;
    const T t60 = t57 * t59;
    const T t61 = t56 - t60;
    const T t62 = t43 * t52;
    const T t63 = points[5] + points[2];
    const T t64 = K(0.5) * t63;
    const T t65 = t62 * t64;
    const T t66 = t61 + t65;
    const T t67 = t53 * t59;
    const T t68 = t55 * t57;
    const T t69 = t67 + t68;
    const T t70 = t47 * t52;
    const T t71 = t64 * t70;
    const T t72 = t69 + t71;
    const T t73 = t41 * t50;
    const T t74 = t53 * t64;
    const T t75 = t55 * t62;
    const T t76 = t74 - t75;
    const T t77 = t59 * t70;
    const T t78 = t76 - t77;
    const T t79 = t43 * t50;
    const T t80 = t47 * t50;
    const T t81 = t57 * t64;
    const T t82 = t59 * t62;
    const T t83 = t81 + t82;
    const T t84 = t55 * t70;
    const T t85 = t83 - t84;
    out[0] = t38;
    out[1] = t42;
    out[2] = -t44;
    out[3] = -t48;
    out[4] = t51;
    out[5] = -t66;
    out[6] = -t72;
    out[7] = t73;
    out[8] = -t78;
    out[9] = -t79;
    out[10] = -t80;
    out[11] = -t85;
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
   24 mul, 15 add, 6 div, 2 sqrt. */
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
    const T t12 = chart[0] * t11;
    const T t13 = K(1.0) + t12;
    const T t14 = t13 * t13;
    const T t15 = t3 / t10;
    const T t16 = t15 * t15;
    const T t17 = t7 / t10;
    const T t18 = t17 * t17;
    const T t19 = t16 + t18;
    const T t20 = t14 + t19;
    const T t21 = K(0.5) * t20;
    const T t22 = chart[0] * t21;
    const T t23 = ROOT(t20);
    const T t24 = t22 / t23;
    const T t25 = chart[0] * t24;
    const T t26 = t1 * t25;
    const T t27 = K(1.0) - chart[0];
    const T t28 = K(0.5) * t27;
    const T t29 = t17 / t23;
    const T t30 = chart[0] * t29;
    const T t31 = t28 * t30;
    const T t32 = t26 - t31;
    const T t33 = t15 / t23;
    const T t34 = chart[0] * t33;
    const T t35 = t1 * t34;
    const T t36 = t28 * t34;
    const T t37 = t1 * t30;
    const T t38 = t25 * t28;
    const T t39 = t37 + t38;
    const T t40 = points[3] + points[0];
    const T t41 = K(0.5) * t40;
    const T t42 = points[4] + points[1];
    const T t43 = K(0.5) * t42;
    const T t44 = points[5] + points[2];
    const T t45 = K(0.5) * t44;
    const T t46 = K(0.5) * t10;
    out[0] = t32;
    out[1] = t35;
    out[2] = -t36;
    out[3] = -t39;
    out[4] = t41;
    out[5] = t43;
    out[6] = t45;
    out[7] = t46;
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
   234 mul, 295 add, 19 div, 3 sqrt. */
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
    const T t17 = t2 / t8;
    const T t18 = chart[0] * t17;
    const T t19 = K(1.0) + t18;
    const T t20 = t19 * t19;
    const T t21 = t16 * t16;
    const T t22 = t5 / t8;
    const T t23 = t22 * t22;
    const T t24 = t21 + t23;
    const T t25 = t20 + t24;
    const T t26 = ROOT(t25);
    const T t27 = t16 / t26;
    const T t28 = chart[0] * t27;
    const T t29 = t15 * t28;
    const T t30 = t13 * t29;
    const T t31 = K(0.5) * t30;
    const T t32 = K(1.0) + chart[0];
    const T t33 = K(0.5) * t32;
    const T t34 = t28 * t33;
    const T t35 = t29 * t34;
    const T t36 = K(0.5) * t25;
    const T t37 = chart[0] * t36;
    const T t38 = t37 / t26;
    const T t39 = chart[0] * t38;
    const T t40 = t33 * t39;
    const T t41 = t22 / t26;
    const T t42 = chart[0] * t41;
    const T t43 = t15 * t42;
    const T t44 = t40 - t43;
    const T t45 = t33 * t42;
    const T t46 = t15 * t39;
    const T t47 = t45 + t46;
    const T t48 = t44 * t47;
    const T t49 = t35 - t48;
    const T t50 = t49 * K(2.0);
    const T t51 = chart[0] * t50;
    const T t52 = K(2.0) * t51;
    const T t53 = t52 / t25;
    const T t54 = t29 * t29;
    const T t55 = t34 * t34;
    const T t56 = t54 + t55;
    const T t57 = K(2.0) * t56;
    const T t58 = K(1.0) - t57;
    const T t59 = t58 / t8;
    const T t60 = t53 * t59;
    const T t61 = t29 * t47;
    const T t62 = t34 * t44;
    const T t63 = t61 + t62;
    const T t64 = K(2.0) * t63;
    const T t65 = chart[0] * t64;
    const T t66 = K(2.0) * t65;
    const T t67 = t66 / t25;
    const T t68 = t34 * t47;
    const T t69 = t29 * t44;
    const T t70 = t68 + t69;
    const T t71 = K(2.0) * t70;
    const T t72 = t71 / t8;
    const T t73 = t67 * t72;
    const T t74 = t60 - t73;
    const T t75 = t31 * t74;
    const T t76 = t13 * t34;
    const T t77 = K(0.5) * t76;
    const T t78 = t59 * t77;
    const T t79 = t75 - t78;
    const T t80 = t13 * t47;
    const T t81 = K(0.5) * t80;
    const T t82 = t72 * t81;
    const T t83 = t79 + t82;
    const T t84 = t10 - t11;
    const T t85 = K(0.5) * t84;
    const T t86 = t44 * t85;
    const T t87 = K(0.5) * t86;
    const T t88 = t61 - t62;
    const T t89 = K(2.0) * t88;
    const T t90 = t89 / t8;
    const T t91 = t87 * t90;
    const T t92 = t83 - t91;
    const T t93 = t64 / t8;
    const T t94 = t53 * t93;
    const T t95 = t50 / t8;
    const T t96 = t67 * t95;
    const T t97 = t94 - t96;
    const T t98 = t31 * t97;
    const T t99 = t77 * t93;
    const T t100 = t98 - t99;
    const T t101 = t81 * t95;
    const T t102 = t100 + t101;
    const T t103 = t47 * t47;
    const T t104 = t55 + t103;
    const T t105 = K(2.0) * t104;
    const T t106 = K(1.0) - t105;
    const T t107 = t106 / t8;
    const T t108 = t87 * t107;
    const T t109 = t102 - t108;
    const T t110 = t68 - t69;
    const T t111 = K(2.0) * t110;
    const T t112 = t111 / t8;
    const T t113 = t53 * t112;
    const T t114 = t54 + t103;
    const T t115 = K(2.0) * t114;
    const T t116 = K(1.0) - t115;
    const T t117 = t116 / t8;
    const T t118 = t67 * t117;
    const T t119 = t113 - t118;
    const T t120 = t31 * t119;
    const T t121 = t77 * t112;
    const T t122 = t120 - t121;
    const T t123 = t81 * t117;
    const T t124 = t122 + t123;
    const T t125 = t35 + t48;
    const T t126 = K(2.0) * t125;
    const T t127 = t126 / t8;
    const T t128 = t87 * t127;
    const T t129 = t124 - t128;
    const T t130 = t13 * t44;
    const T t131 = K(0.5) * t130;
    const T t132 = t59 * t131;
    const T t133 = t31 * t72;
    const T t134 = t132 + t133;
    const T t135 = t74 * t81;
    const T t136 = t134 - t135;
    const T t137 = t34 * t85;
    const T t138 = K(0.5) * t137;
    const T t139 = t90 * t138;
    const T t140 = t136 - t139;
    const T t141 = t93 * t131;
    const T t142 = t31 * t95;
    const T t143 = t141 + t142;
    const T t144 = t81 * t97;
    const T t145 = t143 - t144;
    const T t146 = t107 * t138;
    const T t147 = t145 - t146;
    const T t148 = t112 * t131;
    const T t149 = t31 * t117;
    const T t150 = t148 + t149;
    const T t151 = t81 * t119;
    const T t152 = t150 - t151;
    const T t153 = t127 * t138;
    const T t154 = t152 - t153;
    const T t155 = t74 * t131;
    const T t156 = t72 * t77;
    const T t157 = t155 + t156;
    const T t158 = t59 * t81;
    const T t159 = t157 + t158;
    const T t160 = t29 * t85;
    const T t161 = K(0.5) * t160;
    const T t162 = t90 * t161;
    const T t163 = t159 + t162;
    const T t164 = t97 * t131;
    const T t165 = t77 * t95;
    const T t166 = t164 + t165;
    const T t167 = t81 * t93;
    const T t168 = t166 + t167;
    const T t169 = t107 * t161;
    const T t170 = t168 + t169;
    const T t171 = t119 * t131;
    const T t172 = t77 * t117;
    const T t173 = t171 + t172;
    const T t174 = t81 * t112;
    const T t175 = t173 + t174;
    const T t176 = t127 * t161;
    const T t177 = t175 + t176;
    const T t178 = t72 * t131;
    const T t179 = t74 * t77;
    const T t180 = t178 - t179;
    const T t181 = t31 * t59;
    const T t182 = t180 - t181;
    const T t183 = t47 * t85;
    const T t184 = K(0.5) * t183;
    const T t185 = t90 * t184;
    const T t186 = t182 + t185;
    const T t187 = t95 * t131;
    const T t188 = t77 * t97;
    const T t189 = t187 - t188;
    const T t190 = t31 * t93;
    const T t191 = t189 - t190;
    const T t192 = t107 * t184;
    const T t193 = t191 + t192;
    const T t194 = t117 * t131;
    const T t195 = t77 * t119;
    const T t196 = t194 - t195;
    const T t197 = t31 * t112;
    const T t198 = t196 - t197;
    const T t199 = t127 * t184;
    const T t200 = t198 + t199;
    const T t201 = t90 * t131;
    const T t202 = t59 * t138;
    const T t203 = t201 + t202;
    const T t204 = t74 * t161;
    const T t205 = t203 - t204;
    const T t206 = t72 * t184;
    const T t207 = t205 - t206;
    const T t208 = t107 * t131;
    const T t209 = t93 * t138;
    const T t210 = t208 + t209;
    const T t211 = t97 * t161;
    const T t212 = t210 - t211;
    const T t213 = t95 * t184;
    const T t214 = t212 - t213;
    const T t215 = t127 * t131;
    const T t216 = t112 * t138;
    const T t217 = t215 + t216;
    const T t218 = t119 * t161;
    const T t219 = t217 - t218;
    const T t220 = t117 * t184;
    const T t221 = t219 - t220;
    const T t222 = t77 * t90;
    const T t223 = t132 - t222;
    const T t224 = t133 + t223;
    const T t225 = t59 * t87;
    const T t226 = t224 + t225;
    const T t227 = K(0.5) / t10;
    const T t228 = t44 * t227;
    const T t229 = points[3] + points[0];
    const T t230 = K(0.5) * t229;
    const T t231 = t228 * t230;
    const T t232 = t34 * t227;
    const T t233 = points[4] + points[1];
    const T t234 = K(0.5) * t233;
    const T t235 = t232 * t234;
    const T t236 = t231 - t235;
    const T t237 = t29 * t227;
    const T t238 = points[5] + points[2];
    const T t239 = K(0.5) * t238;
    const T t240 = t237 * t239;
    const T t241 = t236 + t240;
    const T t242 = K(0.5) * t241;
    const T t243 = t90 * t242;
    const T t244 = t226 - t243;
    const T t245 = t228 * t234;
    const T t246 = t230 * t232;
    const T t247 = t245 + t246;
    const T t248 = t47 * t227;
    const T t249 = t239 * t248;
    const T t250 = t247 + t249;
    const T t251 = K(0.5) * t250;
    const T t252 = t59 * t251;
    const T t253 = t244 + t252;
    const T t254 = t139 - t253;
    const T t255 = t228 * t239;
    const T t256 = t230 * t237;
    const T t257 = t255 - t256;
    const T t258 = t234 * t248;
    const T t259 = t257 - t258;
    const T t260 = K(0.5) * t259;
    const T t261 = t74 * t260;
    const T t262 = t254 - t261;
    const T t263 = t72 * t161;
    const T t264 = t262 - t263;
    const T t265 = t232 * t239;
    const T t266 = t234 * t237;
    const T t267 = t265 + t266;
    const T t268 = t230 * t248;
    const T t269 = t267 - t268;
    const T t270 = K(0.5) * t269;
    const T t271 = t72 * t270;
    const T t272 = t264 - t271;
    const T t273 = t77 * t107;
    const T t274 = t141 - t273;
    const T t275 = t142 + t274;
    const T t276 = t87 * t93;
    const T t277 = t275 + t276;
    const T t278 = t107 * t242;
    const T t279 = t277 - t278;
    const T t280 = t93 * t251;
    const T t281 = t279 + t280;
    const T t282 = t146 - t281;
    const T t283 = t97 * t260;
    const T t284 = t282 - t283;
    const T t285 = t95 * t161;
    const T t286 = t284 - t285;
    const T t287 = t95 * t270;
    const T t288 = t286 - t287;
    const T t289 = t77 * t127;
    const T t290 = t148 - t289;
    const T t291 = t149 + t290;
    const T t292 = t87 * t112;
    const T t293 = t291 + t292;
    const T t294 = t127 * t242;
    const T t295 = t293 - t294;
    const T t296 = t112 * t251;
    const T t297 = t295 + t296;
    const T t298 = t153 - t297;
    const T t299 = t119 * t260;
    const T t300 = t298 - t299;
    const T t301 = t117 * t161;
    const T t302 = t300 - t301;
    const T t303 = t117 * t270;
    const T t304 = t302 - t303;
    const T t305 = t226 + t243;
    const T t306 = t252 - t305;
    const T t307 = t139 + t306;
    const T t308 = t261 + t307;
    const T t309 = t263 - t308;
    const T t310 = t271 - t309;
    const T t311 = t277 + t278;
    const T t312 = t280 - t311;
    const T t313 = t146 + t312;
    const T t314 = t283 + t313;
    const T t315 = t285 - t314;
    const T t316 = t287 - t315;
    const T t317 = t293 + t294;
    const T t318 = t296 - t317;
    const T t319 = t153 + t318;
    const T t320 = t299 + t319;
    const T t321 = t301 - t320;
    const T t322 = t303 - t321;
    const T t323 = t78 + t201;
    const T t324 = t82 - t323;
    const T t325 = t91 - t324;
    const T t326 = t59 * t242;
    const T t327 = t325 + t326;
    const T t328 = t90 * t251;
    const T t329 = t327 + t328;
    const T t330 = t202 + t329;
    const T t331 = t72 * t260;
    const T t332 = t330 - t331;
    const T t333 = t206 - t332;
    const T t334 = t74 * t270;
    const T t335 = t333 - t334;
    const T t336 = t99 + t208;
    const T t337 = t101 - t336;
    const T t338 = t108 - t337;
    const T t339 = t93 * t242;
    const T t340 = t338 + t339;
    const T t341 = t107 * t251;
    const T t342 = t340 + t341;
    const T t343 = t209 + t342;
    const T t344 = t95 * t260;
    const T t345 = t343 - t344;
    const T t346 = t213 - t345;
    const T t347 = t97 * t270;
    const T t348 = t346 - t347;
    const T t349 = t121 + t215;
    const T t350 = t123 - t349;
    const T t351 = t128 - t350;
    const T t352 = t112 * t242;
    const T t353 = t351 + t352;
    const T t354 = t127 * t251;
    const T t355 = t353 + t354;
    const T t356 = t216 + t355;
    const T t357 = t117 * t260;
    const T t358 = t356 - t357;
    const T t359 = t220 - t358;
    const T t360 = t119 * t270;
    const T t361 = t359 - t360;
    const T t362 = t325 - t326;
    const T t363 = t328 - t362;
    const T t364 = t202 - t363;
    const T t365 = t331 + t364;
    const T t366 = t206 - t365;
    const T t367 = t334 + t366;
    const T t368 = t338 - t339;
    const T t369 = t341 - t368;
    const T t370 = t209 - t369;
    const T t371 = t344 + t370;
    const T t372 = t213 - t371;
    const T t373 = t347 + t372;
    const T t374 = t351 - t352;
    const T t375 = t354 - t374;
    const T t376 = t216 - t375;
    const T t377 = t357 + t376;
    const T t378 = t220 - t377;
    const T t379 = t360 + t378;
    const T t380 = t222 - t225;
    const T t381 = t263 - t380;
    const T t382 = t74 * t184;
    const T t383 = t381 - t382;
    const T t384 = t273 - t276;
    const T t385 = t285 - t384;
    const T t386 = t97 * t184;
    const T t387 = t385 - t386;
    const T t388 = t289 - t292;
    const T t389 = t301 - t388;
    const T t390 = t119 * t184;
    const T t391 = t389 - t390;
    const T t392 = t178 - t181;
    const T t393 = t81 * t90;
    const T t394 = t392 + t393;
    const T t395 = t72 * t87;
    const T t396 = t394 + t395;
    const T t397 = t74 * t242;
    const T t398 = t396 + t397;
    const T t399 = t72 * t251;
    const T t400 = t398 + t399;
    const T t401 = t90 * t260;
    const T t402 = t400 + t401;
    const T t403 = t59 * t161;
    const T t404 = t402 - t403;
    const T t405 = t185 + t404;
    const T t406 = t59 * t270;
    const T t407 = t405 - t406;
    const T t408 = t187 - t190;
    const T t409 = t81 * t107;
    const T t410 = t408 + t409;
    const T t411 = t87 * t95;
    const T t412 = t410 + t411;
    const T t413 = t97 * t242;
    const T t414 = t412 + t413;
    const T t415 = t95 * t251;
    const T t416 = t414 + t415;
    const T t417 = t107 * t260;
    const T t418 = t416 + t417;
    const T t419 = t93 * t161;
    const T t420 = t418 - t419;
    const T t421 = t192 + t420;
    const T t422 = t93 * t270;
    const T t423 = t421 - t422;
    const T t424 = t194 - t197;
    const T t425 = t81 * t127;
    const T t426 = t424 + t425;
    const T t427 = t87 * t117;
    const T t428 = t426 + t427;
    const T t429 = t119 * t242;
    const T t430 = t428 + t429;
    const T t431 = t117 * t251;
    const T t432 = t430 + t431;
    const T t433 = t127 * t260;
    const T t434 = t432 + t433;
    const T t435 = t112 * t161;
    const T t436 = t434 - t435;
    const T t437 = t199 + t436;
    const T t438 = t112 * t270;
    const T t439 = t437 - t438;
    const T t440 = t396 - t397;
    const T t441 = t399 - t440;
    const T t442 = t401 + t441;
    const T t443 = t403 + t442;
    const T t444 = t185 - t443;
    const T t445 = t406 + t444;
    const T t446 = t412 - t413;
    const T t447 = t415 - t446;
    const T t448 = t417 + t447;
    const T t449 = t419 + t448;
    const T t450 = t192 - t449;
    const T t451 = t422 + t450;
    const T t452 = t428 - t429;
    const T t453 = t431 - t452;
    const T t454 = t433 + t453;
    const T t455 = t435 + t454;
    const T t456 = t199 - t455;
    const T t457 = t438 + t456;
    const T t458 = t74 * t87;
    const T t459 = t31 * t90;
    const T t460 = t458 + t459;
    const T t461 = t72 * t138;
    const T t462 = t460 + t461;
    const T t463 = t59 * t184;
    const T t464 = t462 + t463;
    const T t465 = t87 * t97;
    const T t466 = t31 * t107;
    const T t467 = t465 + t466;
    const T t468 = t95 * t138;
    const T t469 = t467 + t468;
    const T t470 = t93 * t184;
    const T t471 = t469 + t470;
    const T t472 = t87 * t119;
    const T t473 = t31 * t127;
    const T t474 = t472 + t473;
    const T t475 = t117 * t138;
    const T t476 = t474 + t475;
    const T t477 = t112 * t184;
    const T t478 = t476 + t477;
    const T t479 = t393 + t395;
    const T t480 = t74 * t138;
    const T t481 = t479 - t480;
    const T t482 = t403 - t481;
    const T t483 = t409 + t411;
    const T t484 = t97 * t138;
    const T t485 = t483 - t484;
    const T t486 = t419 - t485;
    const T t487 = t425 + t427;
    const T t488 = t119 * t138;
    const T t489 = t487 - t488;
    const T t490 = t435 - t489;
    const T t491 = t156 + t459;
    const T t492 = t158 + t491;
    const T t493 = t72 * t242;
    const T t494 = t492 + t493;
    const T t495 = t74 * t251;
    const T t496 = t494 - t495;
    const T t497 = t461 + t496;
    const T t498 = t59 * t260;
    const T t499 = t497 + t498;
    const T t500 = t162 + t499;
    const T t501 = t463 + t500;
    const T t502 = t90 * t270;
    const T t503 = t501 + t502;
    const T t504 = t165 + t466;
    const T t505 = t167 + t504;
    const T t506 = t95 * t242;
    const T t507 = t505 + t506;
    const T t508 = t97 * t251;
    const T t509 = t507 - t508;
    const T t510 = t468 + t509;
    const T t511 = t93 * t260;
    const T t512 = t510 + t511;
    const T t513 = t169 + t512;
    const T t514 = t470 + t513;
    const T t515 = t107 * t270;
    const T t516 = t514 + t515;
    const T t517 = t172 + t473;
    const T t518 = t174 + t517;
    const T t519 = t117 * t242;
    const T t520 = t518 + t519;
    const T t521 = t119 * t251;
    const T t522 = t520 - t521;
    const T t523 = t475 + t522;
    const T t524 = t112 * t260;
    const T t525 = t523 + t524;
    const T t526 = t176 + t525;
    const T t527 = t477 + t526;
    const T t528 = t127 * t270;
    const T t529 = t527 + t528;
    const T t530 = t492 - t493;
    const T t531 = t495 + t530;
    const T t532 = t461 + t531;
    const T t533 = t498 - t532;
    const T t534 = t162 - t533;
    const T t535 = t463 + t534;
    const T t536 = t502 - t535;
    const T t537 = t505 - t506;
    const T t538 = t508 + t537;
    const T t539 = t468 + t538;
    const T t540 = t511 - t539;
    const T t541 = t169 - t540;
    const T t542 = t470 + t541;
    const T t543 = t515 - t542;
    const T t544 = t518 - t519;
    const T t545 = t521 + t544;
    const T t546 = t475 + t545;
    const T t547 = t524 - t546;
    const T t548 = t176 - t547;
    const T t549 = t477 + t548;
    const T t550 = t528 - t549;
    out[0] = -t92;
    out[1] = t109;
    out[2] = t129;
    out[3] = t92;
    out[4] = -t109;
    out[5] = -t129;
    out[6] = -t140;
    out[7] = t147;
    out[8] = t154;
    out[9] = t140;
    out[10] = -t147;
    out[11] = -t154;
    out[12] = -t163;
    out[13] = t170;
    out[14] = t177;
    out[15] = t163;
    out[16] = -t170;
    out[17] = -t177;
    out[18] = -t186;
    out[19] = t193;
    out[20] = t200;
    out[21] = t186;
    out[22] = -t193;
    out[23] = -t200;
    out[24] = t207;
    out[25] = -t214;
    out[26] = -t221;
    out[27] = -t207;
    out[28] = t214;
    out[29] = t221;
    out[30] = t272;
    out[31] = -t288;
    out[32] = -t304;
    out[33] = t310;
    out[34] = -t316;
    out[35] = -t322;
    out[36] = -t335;
    out[37] = t348;
    out[38] = t361;
    out[39] = -t367;
    out[40] = t373;
    out[41] = t379;
    out[42] = -t383;
    out[43] = t387;
    out[44] = t391;
    out[45] = t383;
    out[46] = -t387;
    out[47] = -t391;
    out[48] = t407;
    out[49] = -t423;
    out[50] = -t439;
    out[51] = t445;
    out[52] = -t451;
    out[53] = -t457;
    out[54] = -t464;
    out[55] = t471;
    out[56] = t478;
    out[57] = t464;
    out[58] = -t471;
    out[59] = -t478;
    out[60] = t482;
    out[61] = -t486;
    out[62] = -t490;
    out[63] = -t482;
    out[64] = t486;
    out[65] = t490;
    out[66] = t503;
    out[67] = -t516;
    out[68] = -t529;
    out[69] = -t536;
    out[70] = t543;
    out[71] = t550;
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
   48 mul, 27 add, 17 div, 2 sqrt. */
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
    const T t12 = t4 / t10;
    const T t13 = chart[0] * t12;
    const T t14 = K(1.0) + t13;
    const T t15 = t14 * t14;
    const T t16 = t11 * t11;
    const T t17 = t7 / t10;
    const T t18 = t17 * t17;
    const T t19 = t16 + t18;
    const T t20 = t15 + t19;
    const T t21 = ROOT(t20);
    const T t22 = t11 / t21;
    const T t23 = chart[0] * t22;
    const T t24 = t1 * t23;
    const T t25 = t24 * t24;
    const T t26 = K(1.0) + chart[0];
    const T t27 = K(0.5) * t26;
    const T t28 = t23 * t27;
    const T t29 = t28 * t28;
    const T t30 = t25 + t29;
    const T t31 = t30 * K(2.0);
    const T t32 = K(1.0) - t31;
    const T t33 = t32 / t10;
    const T t34 = t17 / t21;
    const T t35 = chart[0] * t34;
    const T t36 = t27 * t35;
    const T t37 = K(0.5) * t20;
    const T t38 = chart[0] * t37;
    const T t39 = t38 / t21;
    const T t40 = chart[0] * t39;
    const T t41 = t1 * t40;
    const T t42 = t36 + t41;
    const T t43 = t24 * t42;
    const T t44 = t27 * t40;
    const T t45 = t1 * t35;
    const T t46 = t44 - t45;
    const T t47 = t28 * t46;
    const T t48 = t43 + t47;
    const T t49 = K(2.0) * t48;
    const T t50 = t49 / t10;
    const T t51 = t24 * t46;
    const T t52 = t28 * t42;
    const T t53 = t51 - t52;
    const T t54 = K(2.0) * t53;
    const T t55 = t54 / t10;
    const T t56 = t24 * t28;
    const T t57 = t42 * t46;
    const T t58 = t56 - t57;
    const T t59 = K(2.0) * t58;
    const T t60 = chart[0] * t59;
    const T t61 = K(2.0) * t60;
    const T t62 = t61 / t20;
    const T t63 = t33 * t62;
    const T t64 = chart[0] * t49;
    const T t65 = K(2.0) * t64;
    const T t66 = t65 / t20;
    const T t67 = t51 + t52;
    const T t68 = K(2.0) * t67;
    const T t69 = t68 / t10;
    const T t70 = t66 * t69;
    const T t71 = t63 - t70;
    const T t72 = t50 * t62;
    const T t73 = t59 / t10;
    const T t74 = t66 * t73;
    const T t75 = t72 - t74;
    const T t76 = t55 * t62;
    const T t77 = t42 * t42;
    const T t78 = t25 + t77;
    const T t79 = K(2.0) * t78;
    const T t80 = K(1.0) - t79;
    const T t81 = t80 / t10;
    const T t82 = t66 * t81;
    const T t83 = t76 + t82;
    const T t84 = t43 - t47;
    const T t85 = K(2.0) * t84;
    const T t86 = t85 / t10;
    const T t87 = t29 + t77;
    const T t88 = K(2.0) * t87;
    const T t89 = K(1.0) - t88;
    const T t90 = t89 / t10;
    const T t91 = t56 + t57;
    const T t92 = K(2.0) * t91;
    const T t93 = t92 / t10;
    out[0] = t33;
    out[1] = -t50;
    out[2] = t55;
    out[3] = -t33;
    out[4] = t50;
    out[5] = -t55;
    out[6] = t71;
    out[7] = -t75;
    out[8] = t83;
    out[9] = -t71;
    out[10] = t75;
    out[11] = -t83;
    out[12] = t69;
    out[13] = -t73;
    out[14] = -t81;
    out[15] = -t69;
    out[16] = t73;
    out[17] = t81;
    out[18] = -t86;
    out[19] = t90;
    out[20] = t93;
    out[21] = t86;
    out[22] = -t90;
    out[23] = -t93;
    out[24] = t33;
    out[25] = -t50;
    out[26] = t55;
    out[27] = t33;
    out[28] = -t50;
    out[29] = t55;
    out[30] = -t86;
    out[31] = t90;
    out[32] = t93;
    out[33] = -t86;
    out[34] = t90;
    out[35] = t93;
    out[36] = -t69;
    out[37] = t73;
    out[38] = t81;
    out[39] = -t69;
    out[40] = t73;
    out[41] = t81;
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
   38 mul, 24 add, 15 div, 2 sqrt. */
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
    const T t12 = t4 / t10;
    const T t13 = chart[0] * t12;
    const T t14 = K(1.0) + t13;
    const T t15 = t14 * t14;
    const T t16 = t11 * t11;
    const T t17 = t7 / t10;
    const T t18 = t17 * t17;
    const T t19 = t16 + t18;
    const T t20 = t15 + t19;
    const T t21 = ROOT(t20);
    const T t22 = t11 / t21;
    const T t23 = chart[0] * t22;
    const T t24 = t1 * t23;
    const T t25 = t24 * t24;
    const T t26 = K(1.0) + chart[0];
    const T t27 = K(0.5) * t26;
    const T t28 = t23 * t27;
    const T t29 = t28 * t28;
    const T t30 = t25 + t29;
    const T t31 = t30 * K(2.0);
    const T t32 = K(1.0) - t31;
    const T t33 = t32 / t10;
    const T t34 = t17 / t21;
    const T t35 = chart[0] * t34;
    const T t36 = t27 * t35;
    const T t37 = K(0.5) * t20;
    const T t38 = chart[0] * t37;
    const T t39 = t38 / t21;
    const T t40 = chart[0] * t39;
    const T t41 = t1 * t40;
    const T t42 = t36 + t41;
    const T t43 = t24 * t42;
    const T t44 = t27 * t40;
    const T t45 = t1 * t35;
    const T t46 = t44 - t45;
    const T t47 = t28 * t46;
    const T t48 = t43 + t47;
    const T t49 = K(2.0) * t48;
    const T t50 = t49 / t10;
    const T t51 = t24 * t46;
    const T t52 = t28 * t42;
    const T t53 = t51 - t52;
    const T t54 = K(2.0) * t53;
    const T t55 = t54 / t10;
    const T t56 = t51 + t52;
    const T t57 = K(2.0) * t56;
    const T t58 = t57 / t10;
    const T t59 = t24 * t28;
    const T t60 = t42 * t46;
    const T t61 = t59 - t60;
    const T t62 = K(2.0) * t61;
    const T t63 = t62 / t10;
    const T t64 = t42 * t42;
    const T t65 = t25 + t64;
    const T t66 = K(2.0) * t65;
    const T t67 = K(1.0) - t66;
    const T t68 = t67 / t10;
    const T t69 = t43 - t47;
    const T t70 = K(2.0) * t69;
    const T t71 = t70 / t10;
    const T t72 = t29 + t64;
    const T t73 = K(2.0) * t72;
    const T t74 = K(1.0) - t73;
    const T t75 = t74 / t10;
    const T t76 = t59 + t60;
    const T t77 = K(2.0) * t76;
    const T t78 = t77 / t10;
    out[0] = t33;
    out[1] = -t50;
    out[2] = t55;
    out[3] = -t33;
    out[4] = t50;
    out[5] = -t55;
    out[6] = K(0.0);
    out[7] = K(0.0);
    out[8] = K(0.0);
    out[9] = K(0.0);
    out[10] = K(0.0);
    out[11] = K(0.0);
    out[12] = t58;
    out[13] = -t63;
    out[14] = -t68;
    out[15] = -t58;
    out[16] = t63;
    out[17] = t68;
    out[18] = -t71;
    out[19] = t75;
    out[20] = t78;
    out[21] = t71;
    out[22] = -t75;
    out[23] = -t78;
    out[24] = t33;
    out[25] = -t50;
    out[26] = t55;
    out[27] = t33;
    out[28] = -t50;
    out[29] = t55;
    out[30] = -t71;
    out[31] = t75;
    out[32] = t78;
    out[33] = -t71;
    out[34] = t75;
    out[35] = t78;
    out[36] = -t58;
    out[37] = t63;
    out[38] = t68;
    out[39] = -t58;
    out[40] = t63;
    out[41] = t68;
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
   128 mul, 74 add, 53 div, 2 sqrt. */
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
    const T t12 = t4 / t10;
    const T t13 = chart[0] * t12;
    const T t14 = K(1.0) + t13;
    const T t15 = t14 * t14;
    const T t16 = t11 * t11;
    const T t17 = t7 / t10;
    const T t18 = t17 * t17;
    const T t19 = t16 + t18;
    const T t20 = t15 + t19;
    const T t21 = ROOT(t20);
    const T t22 = t11 / t21;
    const T t23 = chart[0] * t22;
    const T t24 = t1 * t23;
    const T t25 = t24 * K(2.0);
    const T t26 = velocities[3] - velocities[0];
    const T t27 = t26 / t10;
    const T t28 = t11 / t10;
    const T t29 = t2 * K(2.0);
    const T t30 = t26 * t29;
    const T t31 = t4 * K(2.0);
    const T t32 = velocities[4] - velocities[1];
    const T t33 = t31 * t32;
    const T t34 = t30 + t33;
    const T t35 = t7 * K(2.0);
    const T t36 = velocities[5] - velocities[2];
    const T t37 = t35 * t36;
    const T t38 = t34 + t37;
    const T t39 = t10 * K(2.0);
    const T t40 = t38 / t39;
    const T t41 = t28 * t40;
    const T t42 = t27 - t41;
    const T t43 = t42 / t21;
    const T t44 = t22 / t21;
    const T t45 = t14 * K(2.0);
    const T t46 = t32 / t10;
    const T t47 = t12 / t10;
    const T t48 = t40 * t47;
    const T t49 = t46 - t48;
    const T t50 = chart[0] * t49;
    const T t51 = t45 * t50;
    const T t52 = t11 * K(2.0);
    const T t53 = t42 * t52;
    const T t54 = t17 * K(2.0);
    const T t55 = t36 / t10;
    const T t56 = t17 / t10;
    const T t57 = t40 * t56;
    const T t58 = t55 - t57;
    const T t59 = t54 * t58;
    const T t60 = t53 + t59;
    const T t61 = t51 + t60;
    const T t62 = t21 * K(2.0);
    const T t63 = t61 / t62;
    const T t64 = t44 * t63;
    const T t65 = t43 - t64;
    const T t66 = chart[0] * t65;
    const T t67 = t1 * t66;
    const T t68 = t25 * t67;
    const T t69 = K(1.0) + chart[0];
    const T t70 = K(0.5) * t69;
    const T t71 = t23 * t70;
    const T t72 = K(2.0) * t71;
    const T t73 = t66 * t70;
    const T t74 = t72 * t73;
    const T t75 = t68 + t74;
    const T t76 = K(2.0) * t75;
    const T t77 = t76 / t10;
    const T t78 = t24 * t24;
    const T t79 = t71 * t71;
    const T t80 = t78 + t79;
    const T t81 = K(2.0) * t80;
    const T t82 = K(1.0) - t81;
    const T t83 = t82 / t10;
    const T t84 = t83 / t10;
    const T t85 = t40 * t84;
    const T t86 = t77 + t85;
    const T t87 = t58 / t21;
    const T t88 = t17 / t21;
    const T t89 = t88 / t21;
    const T t90 = t63 * t89;
    const T t91 = t87 - t90;
    const T t92 = chart[0] * t91;
    const T t93 = t70 * t92;
    const T t94 = K(0.5) * t61;
    const T t95 = chart[0] * t94;
    const T t96 = t95 / t21;
    const T t97 = K(0.5) * t20;
    const T t98 = chart[0] * t97;
    const T t99 = t98 / t21;
    const T t100 = t99 / t21;
    const T t101 = t63 * t100;
    const T t102 = t96 - t101;
    const T t103 = chart[0] * t102;
    const T t104 = t1 * t103;
    const T t105 = t93 + t104;
    const T t106 = t24 * t105;
    const T t107 = chart[0] * t88;
    const T t108 = t70 * t107;
    const T t109 = chart[0] * t99;
    const T t110 = t1 * t109;
    const T t111 = t108 + t110;
    const T t112 = t67 * t111;
    const T t113 = t106 + t112;
    const T t114 = t70 * t103;
    const T t115 = t1 * t92;
    const T t116 = t114 - t115;
    const T t117 = t71 * t116;
    const T t118 = t70 * t109;
    const T t119 = t1 * t107;
    const T t120 = t118 - t119;
    const T t121 = t73 * t120;
    const T t122 = t117 + t121;
    const T t123 = t113 + t122;
    const T t124 = K(2.0) * t123;
    const T t125 = t124 / t10;
    const T t126 = t24 * t111;
    const T t127 = t71 * t120;
    const T t128 = t126 + t127;
    const T t129 = K(2.0) * t128;
    const T t130 = t129 / t10;
    const T t131 = t130 / t10;
    const T t132 = t40 * t131;
    const T t133 = t125 - t132;
    const T t134 = t24 * t116;
    const T t135 = t67 * t120;
    const T t136 = t134 + t135;
    const T t137 = t71 * t105;
    const T t138 = t73 * t111;
    const T t139 = t137 + t138;
    const T t140 = t136 - t139;
    const T t141 = K(2.0) * t140;
    const T t142 = t141 / t10;
    const T t143 = t24 * t120;
    const T t144 = t71 * t111;
    const T t145 = t143 - t144;
    const T t146 = K(2.0) * t145;
    const T t147 = t146 / t10;
    const T t148 = t147 / t10;
    const T t149 = t40 * t148;
    const T t150 = t142 - t149;
    const T t151 = t67 * t71;
    const T t152 = t24 * t73;
    const T t153 = t151 + t152;
    const T t154 = t111 * t116;
    const T t155 = t105 * t120;
    const T t156 = t154 + t155;
    const T t157 = t153 - t156;
    const T t158 = K(2.0) * t157;
    const T t159 = chart[0] * t158;
    const T t160 = K(2.0) * t159;
    const T t161 = t160 / t20;
    const T t162 = t24 * t71;
    const T t163 = t111 * t120;
    const T t164 = t162 - t163;
    const T t165 = K(2.0) * t164;
    const T t166 = chart[0] * t165;
    const T t167 = K(2.0) * t166;
    const T t168 = t167 / t20;
    const T t169 = t168 / t20;
    const T t170 = t61 * t169;
    const T t171 = t161 - t170;
    const T t172 = t83 * t171;
    const T t173 = t86 * t168;
    const T t174 = t172 - t173;
    const T t175 = t143 + t144;
    const T t176 = K(2.0) * t175;
    const T t177 = t176 / t10;
    const T t178 = chart[0] * t124;
    const T t179 = K(2.0) * t178;
    const T t180 = t179 / t20;
    const T t181 = chart[0] * t129;
    const T t182 = K(2.0) * t181;
    const T t183 = t182 / t20;
    const T t184 = t183 / t20;
    const T t185 = t61 * t184;
    const T t186 = t180 - t185;
    const T t187 = t177 * t186;
    const T t188 = t136 + t139;
    const T t189 = K(2.0) * t188;
    const T t190 = t189 / t10;
    const T t191 = t177 / t10;
    const T t192 = t40 * t191;
    const T t193 = t190 - t192;
    const T t194 = t183 * t193;
    const T t195 = t187 + t194;
    const T t196 = t174 - t195;
    const T t197 = t130 * t171;
    const T t198 = t133 * t168;
    const T t199 = t197 + t198;
    const T t200 = t165 / t10;
    const T t201 = t186 * t200;
    const T t202 = t158 / t10;
    const T t203 = t200 / t10;
    const T t204 = t40 * t203;
    const T t205 = t202 - t204;
    const T t206 = t183 * t205;
    const T t207 = t201 + t206;
    const T t208 = t199 - t207;
    const T t209 = t147 * t171;
    const T t210 = t150 * t168;
    const T t211 = t209 + t210;
    const T t212 = t111 * t111;
    const T t213 = t78 + t212;
    const T t214 = K(2.0) * t213;
    const T t215 = K(1.0) - t214;
    const T t216 = t215 / t10;
    const T t217 = t186 * t216;
    const T t218 = K(2.0) * t111;
    const T t219 = t105 * t218;
    const T t220 = t68 + t219;
    const T t221 = K(2.0) * t220;
    const T t222 = t221 / t10;
    const T t223 = t216 / t10;
    const T t224 = t40 * t223;
    const T t225 = t222 + t224;
    const T t226 = t183 * t225;
    const T t227 = t217 - t226;
    const T t228 = t211 + t227;
    const T t229 = t113 - t122;
    const T t230 = K(2.0) * t229;
    const T t231 = t230 / t10;
    const T t232 = t126 - t127;
    const T t233 = K(2.0) * t232;
    const T t234 = t233 / t10;
    const T t235 = t234 / t10;
    const T t236 = t40 * t235;
    const T t237 = t231 - t236;
    const T t238 = t74 + t219;
    const T t239 = K(2.0) * t238;
    const T t240 = t239 / t10;
    const T t241 = t79 + t212;
    const T t242 = K(2.0) * t241;
    const T t243 = K(1.0) - t242;
    const T t244 = t243 / t10;
    const T t245 = t244 / t10;
    const T t246 = t40 * t245;
    const T t247 = t240 + t246;
    const T t248 = t153 + t156;
    const T t249 = K(2.0) * t248;
    const T t250 = t249 / t10;
    const T t251 = t162 + t163;
    const T t252 = K(2.0) * t251;
    const T t253 = t252 / t10;
    const T t254 = t253 / t10;
    const T t255 = t40 * t254;
    const T t256 = t250 - t255;
    out[0] = -t86;
    out[1] = -t133;
    out[2] = t150;
    out[3] = t86;
    out[4] = t133;
    out[5] = -t150;
    out[6] = t196;
    out[7] = -t208;
    out[8] = t228;
    out[9] = -t196;
    out[10] = t208;
    out[11] = -t228;
    out[12] = t193;
    out[13] = -t205;
    out[14] = t225;
    out[15] = -t193;
    out[16] = t205;
    out[17] = -t225;
    out[18] = -t237;
    out[19] = -t247;
    out[20] = t256;
    out[21] = t237;
    out[22] = t247;
    out[23] = -t256;
    out[24] = -t86;
    out[25] = -t133;
    out[26] = t150;
    out[27] = -t86;
    out[28] = -t133;
    out[29] = t150;
    out[30] = -t237;
    out[31] = -t247;
    out[32] = t256;
    out[33] = -t237;
    out[34] = -t247;
    out[35] = t256;
    out[36] = -t193;
    out[37] = t205;
    out[38] = -t225;
    out[39] = -t193;
    out[40] = t205;
    out[41] = -t225;
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
   106 mul, 63 add, 47 div, 2 sqrt. */
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
    const T t12 = t4 / t10;
    const T t13 = chart[0] * t12;
    const T t14 = K(1.0) + t13;
    const T t15 = t14 * t14;
    const T t16 = t11 * t11;
    const T t17 = t7 / t10;
    const T t18 = t17 * t17;
    const T t19 = t16 + t18;
    const T t20 = t15 + t19;
    const T t21 = ROOT(t20);
    const T t22 = t11 / t21;
    const T t23 = chart[0] * t22;
    const T t24 = t1 * t23;
    const T t25 = t24 * K(2.0);
    const T t26 = velocities[3] - velocities[0];
    const T t27 = t26 / t10;
    const T t28 = t11 / t10;
    const T t29 = t2 * K(2.0);
    const T t30 = t26 * t29;
    const T t31 = t4 * K(2.0);
    const T t32 = velocities[4] - velocities[1];
    const T t33 = t31 * t32;
    const T t34 = t30 + t33;
    const T t35 = t7 * K(2.0);
    const T t36 = velocities[5] - velocities[2];
    const T t37 = t35 * t36;
    const T t38 = t34 + t37;
    const T t39 = t10 * K(2.0);
    const T t40 = t38 / t39;
    const T t41 = t28 * t40;
    const T t42 = t27 - t41;
    const T t43 = t42 / t21;
    const T t44 = t22 / t21;
    const T t45 = t14 * K(2.0);
    const T t46 = t32 / t10;
    const T t47 = t12 / t10;
    const T t48 = t40 * t47;
    const T t49 = t46 - t48;
    const T t50 = chart[0] * t49;
    const T t51 = t45 * t50;
    const T t52 = t11 * K(2.0);
    const T t53 = t42 * t52;
    const T t54 = t17 * K(2.0);
    const T t55 = t36 / t10;
    const T t56 = t17 / t10;
    const T t57 = t40 * t56;
    const T t58 = t55 - t57;
    const T t59 = t54 * t58;
    const T t60 = t53 + t59;
    const T t61 = t51 + t60;
    const T t62 = t21 * K(2.0);
    const T t63 = t61 / t62;
    const T t64 = t44 * t63;
    const T t65 = t43 - t64;
    const T t66 = chart[0] * t65;
    const T t67 = t1 * t66;
    const T t68 = t25 * t67;
    const T t69 = K(1.0) + chart[0];
    const T t70 = K(0.5) * t69;
    const T t71 = t23 * t70;
    const T t72 = K(2.0) * t71;
    const T t73 = t66 * t70;
    const T t74 = t72 * t73;
    const T t75 = t68 + t74;
    const T t76 = K(2.0) * t75;
    const T t77 = t76 / t10;
    const T t78 = t24 * t24;
    const T t79 = t71 * t71;
    const T t80 = t78 + t79;
    const T t81 = K(2.0) * t80;
    const T t82 = K(1.0) - t81;
    const T t83 = t82 / t10;
    const T t84 = t83 / t10;
    const T t85 = t40 * t84;
    const T t86 = t77 + t85;
    const T t87 = t58 / t21;
    const T t88 = t17 / t21;
    const T t89 = t88 / t21;
    const T t90 = t63 * t89;
    const T t91 = t87 - t90;
    const T t92 = chart[0] * t91;
    const T t93 = t70 * t92;
    const T t94 = K(0.5) * t61;
    const T t95 = chart[0] * t94;
    const T t96 = t95 / t21;
    const T t97 = K(0.5) * t20;
    const T t98 = chart[0] * t97;
    const T t99 = t98 / t21;
    const T t100 = t99 / t21;
    const T t101 = t63 * t100;
    const T t102 = t96 - t101;
    const T t103 = chart[0] * t102;
    const T t104 = t1 * t103;
    const T t105 = t93 + t104;
    const T t106 = t24 * t105;
    const T t107 = chart[0] * t88;
    const T t108 = t70 * t107;
    const T t109 = chart[0] * t99;
    const T t110 = t1 * t109;
    const T t111 = t108 + t110;
    const T t112 = t67 * t111;
    const T t113 = t106 + t112;
    const T t114 = t70 * t103;
    const T t115 = t1 * t92;
    const T t116 = t114 - t115;
    const T t117 = t71 * t116;
    const T t118 = t70 * t109;
    const T t119 = t1 * t107;
    const T t120 = t118 - t119;
    const T t121 = t73 * t120;
    const T t122 = t117 + t121;
    const T t123 = t113 + t122;
    const T t124 = K(2.0) * t123;
    const T t125 = t124 / t10;
    const T t126 = t24 * t111;
    const T t127 = t71 * t120;
    const T t128 = t126 + t127;
    const T t129 = K(2.0) * t128;
    const T t130 = t129 / t10;
    const T t131 = t130 / t10;
    const T t132 = t40 * t131;
    const T t133 = t125 - t132;
    const T t134 = t24 * t116;
    const T t135 = t67 * t120;
    const T t136 = t134 + t135;
    const T t137 = t71 * t105;
    const T t138 = t73 * t111;
    const T t139 = t137 + t138;
    const T t140 = t136 - t139;
    const T t141 = K(2.0) * t140;
    const T t142 = t141 / t10;
    const T t143 = t24 * t120;
    const T t144 = t71 * t111;
    const T t145 = t143 - t144;
    const T t146 = K(2.0) * t145;
    const T t147 = t146 / t10;
    const T t148 = t147 / t10;
    const T t149 = t40 * t148;
    const T t150 = t142 - t149;
    const T t151 = t136 + t139;
    const T t152 = K(2.0) * t151;
    const T t153 = t152 / t10;
    const T t154 = t143 + t144;
    const T t155 = K(2.0) * t154;
    const T t156 = t155 / t10;
    const T t157 = t156 / t10;
    const T t158 = t40 * t157;
    const T t159 = t153 - t158;
    const T t160 = t67 * t71;
    const T t161 = t24 * t73;
    const T t162 = t160 + t161;
    const T t163 = t111 * t116;
    const T t164 = t105 * t120;
    const T t165 = t163 + t164;
    const T t166 = t162 - t165;
    const T t167 = K(2.0) * t166;
    const T t168 = t167 / t10;
    const T t169 = t24 * t71;
    const T t170 = t111 * t120;
    const T t171 = t169 - t170;
    const T t172 = K(2.0) * t171;
    const T t173 = t172 / t10;
    const T t174 = t173 / t10;
    const T t175 = t40 * t174;
    const T t176 = t168 - t175;
    const T t177 = K(2.0) * t111;
    const T t178 = t105 * t177;
    const T t179 = t68 + t178;
    const T t180 = K(2.0) * t179;
    const T t181 = t180 / t10;
    const T t182 = t111 * t111;
    const T t183 = t78 + t182;
    const T t184 = K(2.0) * t183;
    const T t185 = K(1.0) - t184;
    const T t186 = t185 / t10;
    const T t187 = t186 / t10;
    const T t188 = t40 * t187;
    const T t189 = t181 + t188;
    const T t190 = t113 - t122;
    const T t191 = K(2.0) * t190;
    const T t192 = t191 / t10;
    const T t193 = t126 - t127;
    const T t194 = K(2.0) * t193;
    const T t195 = t194 / t10;
    const T t196 = t195 / t10;
    const T t197 = t40 * t196;
    const T t198 = t192 - t197;
    const T t199 = t74 + t178;
    const T t200 = K(2.0) * t199;
    const T t201 = t200 / t10;
    const T t202 = t79 + t182;
    const T t203 = K(2.0) * t202;
    const T t204 = K(1.0) - t203;
    const T t205 = t204 / t10;
    const T t206 = t205 / t10;
    const T t207 = t40 * t206;
    const T t208 = t201 + t207;
    const T t209 = t162 + t165;
    const T t210 = K(2.0) * t209;
    const T t211 = t210 / t10;
    const T t212 = t169 + t170;
    const T t213 = K(2.0) * t212;
    const T t214 = t213 / t10;
    const T t215 = t214 / t10;
    const T t216 = t40 * t215;
    const T t217 = t211 - t216;
    out[0] = -t86;
    out[1] = -t133;
    out[2] = t150;
    out[3] = t86;
    out[4] = t133;
    out[5] = -t150;
    out[6] = K(0.0);
    out[7] = K(0.0);
    out[8] = K(0.0);
    out[9] = K(0.0);
    out[10] = K(0.0);
    out[11] = K(0.0);
    out[12] = t159;
    out[13] = -t176;
    out[14] = t189;
    out[15] = -t159;
    out[16] = t176;
    out[17] = -t189;
    out[18] = -t198;
    out[19] = -t208;
    out[20] = t217;
    out[21] = t198;
    out[22] = t208;
    out[23] = -t217;
    out[24] = -t86;
    out[25] = -t133;
    out[26] = t150;
    out[27] = -t86;
    out[28] = -t133;
    out[29] = t150;
    out[30] = -t198;
    out[31] = -t208;
    out[32] = t217;
    out[33] = -t198;
    out[34] = -t208;
    out[35] = t217;
    out[36] = -t159;
    out[37] = t176;
    out[38] = -t189;
    out[39] = -t159;
    out[40] = t176;
    out[41] = -t189;
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

/* What is looked at before the rest is trusted. Total. From cga_codegen.kernels.primitives.guard.
   9 mul, 12 add, 2 div, 1 sqrt. */
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
    const T t11 = t1 + t6;
    const T t12 = t11 / t8;
    const T t13 = points[0] * points[0];
    const T t14 = points[1] * points[1];
    const T t15 = t13 + t14;
    const T t16 = points[2] * points[2];
    const T t17 = t15 + t16;
    const T t18 = points[3] * points[3];
    const T t19 = points[4] * points[4];
    const T t20 = t18 + t19;
    const T t21 = points[5] * points[5];
    const T t22 = t20 + t21;
    const T t23 = t17 + t22;
    out[0] = t9;
    out[1] = t10;
    out[2] = t12;
    out[3] = t23;
    out[4] = t7;
}

CGA_EXPORT int cga_cooperative_point_pair_guard(const double *restrict points /* 6 */, double *restrict out /* 5 */)
{
    cga_cooperative_point_pair_guard_body(points, out);
    return cga_not_finite(points, 6);
}

CGA_EXPORT int cga_cooperative_point_pair_guard_batch(int64_t n, const double *restrict points /* 6 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_cooperative_point_pair_guard(points + k * 6, out + k * 5);
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
