/* The kernel mass_matrix of tm5_700. Made by `cga generate`; do not edit: the loader checks digests, and the next run overwrites it. */

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

/* M(q), symmetric, n x n, rotors included, by composite inertias. From cga_codegen.kernels.dynamics.mass_matrix.
   95 mul, 94 add, 0 div, 0 sqrt. */
static inline void cga_tm5_700_tree_mass_matrix_body(const T *restrict c, const T *restrict s, T *restrict out)
{
    const T t0 = c[5] * K(0.000609267);
    const T t1 = c[5] * t0;
    const T t2 = K(0.001383811) - t1;
    const T t3 = K(0.002058405) + t2;
    const T t4 = t3 + K(0.008321899625);
    const T t5 = K(0.004122575) - t4;
    const T t6 = c[4] * t5;
    const T t7 = c[4] * t6;
    const T t8 = K(0.004122575) - t7;
    const T t9 = K(0.002058405) + t8;
    const T t10 = t9 + K(0.025011336);
    const T t11 = t1 + K(0.000774544);
    const T t12 = K(0.00264321) + t11;
    const T t13 = K(0.008321899625) + t12;
    const T t14 = K(0.002563079) + t13;
    const T t15 = t10 - t14;
    const T t16 = c[3] * t15;
    const T t17 = K(0.007796035) * s[4];
    const T t18 = t0 * s[5];
    const T t19 = c[4] * t18;
    const T t20 = t17 + t19;
    const T t21 = s[3] * t20;
    const T t22 = t21 * K(2.0);
    const T t23 = t16 - t22;
    const T t24 = c[3] * t23;
    const T t25 = t10 - t24;
    const T t26 = K(0.003380181) + t25;
    const T t27 = c[3] * K(0.235956);
    const T t28 = s[4] * K(0.0735475);
    const T t29 = s[3] * t28;
    const T t30 = t27 - t29;
    const T t31 = K(1.184323) + t30;
    const T t32 = t30 + t31;
    const T t33 = K(0.3115) * t32;
    const T t34 = c[4] * K(0.0735475);
    const T t35 = t34 + K(0.4649846);
    const T t36 = t34 + t35;
    const T t37 = K(0.1223) * t36;
    const T t38 = t33 + t37;
    const T t39 = K(0.3115) * t31;
    const T t40 = t38 - t39;
    const T t41 = K(0.3115) * t30;
    const T t42 = t40 - t41;
    const T t43 = t26 + t42;
    const T t44 = t14 + t24;
    const T t45 = K(0.033829144) + t44;
    const T t46 = t38 + t45;
    const T t47 = t43 - t46;
    const T t48 = c[2] * t47;
    const T t49 = c[3] * t28;
    const T t50 = s[3] * K(0.235956);
    const T t51 = t49 + t50;
    const T t52 = K(0.3115) * t51;
    const T t53 = s[3] * t23;
    const T t54 = t20 + t53;
    const T t55 = t52 + t54;
    const T t56 = s[2] * t55;
    const T t57 = K(2.0) * t56;
    const T t58 = t48 + t57;
    const T t59 = c[2] * t58;
    const T t60 = t43 - t59;
    const T t61 = K(0.19825197) + t60;
    const T t62 = t31 * c[2];
    const T t63 = s[2] * t51;
    const T t64 = t62 - t63;
    const T t65 = t64 + K(1.9986750000000002);
    const T t66 = t64 + t65;
    const T t67 = K(0.329) * t66;
    const T t68 = t61 + t67;
    const T t69 = t46 + t59;
    const T t70 = K(0.023552072) + t69;
    const T t71 = K(0.329) * t65;
    const T t72 = t67 - t71;
    const T t73 = K(0.329) * t64;
    const T t74 = t72 - t73;
    const T t75 = t70 + t74;
    const T t76 = t68 - t75;
    const T t77 = c[1] * t76;
    const T t78 = s[2] * t58;
    const T t79 = t55 - t78;
    const T t80 = t31 * s[2];
    const T t81 = c[2] * t51;
    const T t82 = t80 + t81;
    const T t83 = K(0.329) * t82;
    const T t84 = t79 + t83;
    const T t85 = s[1] * t84;
    const T t86 = K(2.0) * t85;
    const T t87 = t77 - t86;
    const T t88 = c[1] * t87;
    const T t89 = t68 - t88;
    const T t90 = K(0.011970081) + t89;
    const T t91 = t30 * K(0.1223);
    const T t92 = K(0.3115) * t35;
    const T t93 = t91 + t92;
    const T t94 = t6 * s[4];
    const T t95 = s[3] * t94;
    const T t96 = s[4] * t18;
    const T t97 = c[4] * K(0.007796035);
    const T t98 = t96 - t97;
    const T t99 = c[3] * t98;
    const T t100 = t95 - t99;
    const T t101 = t93 + t100;
    const T t102 = c[2] * t101;
    const T t103 = c[3] * t94;
    const T t104 = s[3] * t98;
    const T t105 = t103 + t104;
    const T t106 = K(0.1223) * t51;
    const T t107 = t105 - t106;
    const T t108 = s[2] * t107;
    const T t109 = t102 + t108;
    const T t110 = t35 * K(0.329);
    const T t111 = t109 + t110;
    const T t112 = c[1] * t111;
    const T t113 = s[2] * t101;
    const T t114 = c[2] * t107;
    const T t115 = t113 - t114;
    const T t116 = s[1] * t115;
    const T t117 = t112 - t116;
    const T t118 = c[1] * t109;
    const T t119 = t116 - t118;
    const T t120 = t91 + t100;
    const T t121 = c[2] * t120;
    const T t122 = t108 + t121;
    const T t123 = c[1] * t122;
    const T t124 = s[2] * t120;
    const T t125 = t114 - t124;
    const T t126 = s[1] * t125;
    const T t127 = t123 + t126;
    const T t128 = c[3] * t13;
    const T t129 = t21 + t128;
    const T t130 = c[3] * t34;
    const T t131 = K(0.1223) * t130;
    const T t132 = t129 + t131;
    const T t133 = c[2] * t132;
    const T t134 = c[3] * t20;
    const T t135 = t13 * s[3];
    const T t136 = t134 - t135;
    const T t137 = s[3] * t34;
    const T t138 = K(0.1223) * t137;
    const T t139 = s[4] * K(0.02291004625);
    const T t140 = t138 - t139;
    const T t141 = t136 - t140;
    const T t142 = s[2] * t141;
    const T t143 = t133 + t142;
    const T t144 = c[1] * t143;
    const T t145 = c[2] * t141;
    const T t146 = s[2] * t132;
    const T t147 = t145 - t146;
    const T t148 = s[4] * K(0.024197127500000002);
    const T t149 = t147 + t148;
    const T t150 = s[1] * t149;
    const T t151 = t144 + t150;
    const T t152 = s[4] * K(0.001559496);
    const T t153 = s[3] * t152;
    const T t154 = c[2] * t153;
    const T t155 = c[3] * t152;
    const T t156 = s[2] * t155;
    const T t157 = t154 + t156;
    const T t158 = c[1] * t157;
    const T t159 = s[2] * t153;
    const T t160 = c[2] * t155;
    const T t161 = t159 - t160;
    const T t162 = s[1] * t161;
    const T t163 = t158 - t162;
    const T t164 = t4 + t7;
    const T t165 = K(0.00264321) + t164;
    const T t166 = K(0.025011336) + t165;
    const T t167 = K(0.034328203) + t166;
    const T t168 = K(0.1223) * t35;
    const T t169 = t38 - t168;
    const T t170 = c[4] * K(0.00899485925);
    const T t171 = t169 - t170;
    const T t172 = t167 + t171;
    const T t173 = K(0.20459254) + t172;
    const T t174 = t67 + t173;
    const T t175 = t73 + t172;
    const T t176 = t41 + t166;
    const T t177 = t30 * c[2];
    const T t178 = t63 - t177;
    const T t179 = K(0.329) * t178;
    const T t180 = t176 - t179;
    const T t181 = K(0.3115) * t130;
    const T t182 = t98 - t181;
    const T t183 = c[2] * t130;
    const T t184 = s[2] * t137;
    const T t185 = t183 - t184;
    const T t186 = K(0.329) * t185;
    const T t187 = t182 - t186;
    const T t188 = c[4] * K(0.001559496);
    out[0] = t90;
    out[1] = t117;
    out[2] = -t119;
    out[3] = t127;
    out[4] = t151;
    out[5] = -t163;
    out[6] = t117;
    out[7] = t174;
    out[8] = t175;
    out[9] = t180;
    out[10] = -t187;
    out[11] = -t188;
    out[12] = -t119;
    out[13] = t175;
    out[14] = t172;
    out[15] = t176;
    out[16] = -t182;
    out[17] = -t188;
    out[18] = t127;
    out[19] = t180;
    out[20] = t176;
    out[21] = t166;
    out[22] = -t98;
    out[23] = -t188;
    out[24] = t151;
    out[25] = -t187;
    out[26] = -t182;
    out[27] = -t98;
    out[28] = t13;
    out[29] = K(0.0);
    out[30] = -t163;
    out[31] = -t188;
    out[32] = -t188;
    out[33] = -t188;
    out[34] = K(0.0);
    out[35] = K(0.001559496);
}

CGA_EXPORT int cga_tm5_700_tree_mass_matrix(const double *restrict q /* 6 */, double *restrict out /* 36 */)
{
    double c[6], s[6];
    for (int j = 0; j < 6; ++j) { c[j] = cos(q[j]); s[j] = sin(q[j]); }
    cga_tm5_700_tree_mass_matrix_body(c, s, out);
    return cga_not_finite(q, 6);
}

CGA_EXPORT int cga_tm5_700_tree_mass_matrix_batch(int64_t n, const double *restrict q /* 6 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_tm5_700_tree_mass_matrix(q + k * 6, out + k * 36);
    return bad;
}
