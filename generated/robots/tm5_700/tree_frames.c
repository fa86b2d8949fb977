/* The kernel frames of tm5_700. Made by `cga generate`; do not edit: the loader checks digests, and the next run overwrites it. */

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

/* Homogeneous matrices of all frames of the robot, in the order of its frame names. From cga_codegen.kernels.tree_kinematics.frames.
   64 mul, 34 add, 0 div, 0 sqrt. */
static inline void cga_tm5_700_tree_frames_body(const T *restrict c, const T *restrict s, T *restrict out)
{
    const T t0 = c[0] * s[1];
    const T t1 = c[0] * c[1];
    const T t2 = s[0] * s[1];
    const T t3 = s[0] * c[1];
    const T t4 = t0 * c[2];
    const T t5 = t1 * s[2];
    const T t6 = t4 + t5;
    const T t7 = t1 * c[2];
    const T t8 = t0 * s[2];
    const T t9 = t7 - t8;
    const T t10 = t0 * K(0.329);
    const T t11 = t2 * c[2];
    const T t12 = t3 * s[2];
    const T t13 = t11 + t12;
    const T t14 = t3 * c[2];
    const T t15 = t2 * s[2];
    const T t16 = t14 - t15;
    const T t17 = t2 * K(0.329);
    const T t18 = c[1] * c[2];
    const T t19 = s[1] * s[2];
    const T t20 = t18 - t19;
    const T t21 = s[1] * c[2];
    const T t22 = c[1] * s[2];
    const T t23 = t21 + t22;
    const T t24 = c[1] * K(0.329);
    const T t25 = K(0.1452) + t24;
    const T t26 = t9 * c[3];
    const T t27 = t6 * s[3];
    const T t28 = t26 - t27;
    const T t29 = t6 * c[3];
    const T t30 = t9 * s[3];
    const T t31 = t29 + t30;
    const T t32 = t6 * K(0.3115);
    const T t33 = s[0] * K(0.1223);
    const T t34 = t32 + t33;
    const T t35 = t10 + t34;
    const T t36 = t16 * c[3];
    const T t37 = t13 * s[3];
    const T t38 = t36 - t37;
    const T t39 = t13 * c[3];
    const T t40 = t16 * s[3];
    const T t41 = t39 + t40;
    const T t42 = t13 * K(0.3115);
    const T t43 = c[0] * K(0.1223);
    const T t44 = t42 - t43;
    const T t45 = t17 + t44;
    const T t46 = t23 * c[3];
    const T t47 = t20 * s[3];
    const T t48 = t46 + t47;
    const T t49 = t23 * s[3];
    const T t50 = t20 * c[3];
    const T t51 = t49 - t50;
    const T t52 = t20 * K(0.3115);
    const T t53 = t25 + t52;
    const T t54 = t28 * c[4];
    const T t55 = s[0] * s[4];
    const T t56 = t54 - t55;
    const T t57 = s[0] * c[4];
    const T t58 = t28 * s[4];
    const T t59 = t57 + t58;
    const T t60 = t31 * K(0.106);
    const T t61 = t35 + t60;
    const T t62 = t38 * c[4];
    const T t63 = c[0] * s[4];
    const T t64 = t62 + t63;
    const T t65 = c[0] * c[4];
    const T t66 = t38 * s[4];
    const T t67 = t65 - t66;
    const T t68 = t41 * K(0.106);
    const T t69 = t45 + t68;
    const T t70 = t48 * c[4];
    const T t71 = t48 * s[4];
    const T t72 = t51 * K(0.106);
    const T t73 = t53 - t72;
    const T t74 = t56 * c[5];
    const T t75 = t31 * s[5];
    const T t76 = t74 + t75;
    const T t77 = t31 * c[5];
    const T t78 = t56 * s[5];
    const T t79 = t77 - t78;
    const T t80 = t59 * K(0.11315);
    const T t81 = t61 + t80;
    const T t82 = t64 * c[5];
    const T t83 = t41 * s[5];
    const T t84 = t82 + t83;
    const T t85 = t41 * c[5];
    const T t86 = t64 * s[5];
    const T t87 = t85 - t86;
    const T t88 = t67 * K(0.11315);
    const T t89 = t69 - t88;
    const T t90 = t70 * c[5];
    const T t91 = t51 * s[5];
    const T t92 = t90 + t91;
    const T t93 = t70 * s[5];
    const T t94 = t51 * c[5];
    const T t95 = t93 - t94;
    const T t96 = t71 * K(0.11315);
    const T t97 = t73 - t96;
    out[0] = K(1.0);
    out[1] = K(0.0);
    out[2] = K(0.0);
    out[3] = K(0.0);
    out[4] = K(0.0);
    out[5] = K(1.0);
    out[6] = K(0.0);
    out[7] = K(0.0);
    out[8] = K(0.0);
    out[9] = K(0.0);
    out[10] = K(1.0);
    out[11] = K(0.0);
    out[12] = K(0.0);
    out[13] = K(0.0);
    out[14] = K(0.0);
    out[15] = K(1.0);
    out[16] = K(1.0);
    out[17] = K(0.0);
    out[18] = K(0.0);
    out[19] = K(0.0);
    out[20] = K(0.0);
    out[21] = K(1.0);
    out[22] = K(0.0);
    out[23] = K(0.0);
    out[24] = K(0.0);
    out[25] = K(0.0);
    out[26] = K(1.0);
    out[27] = K(0.0);
    out[28] = K(0.0);
    out[29] = K(0.0);
    out[30] = K(0.0);
    out[31] = K(1.0);
    out[32] = K(1.0);
    out[33] = K(0.0);
    out[34] = K(0.0);
    out[35] = K(0.0);
    out[36] = K(0.0);
    out[37] = K(1.0);
    out[38] = K(0.0);
    out[39] = K(0.0);
    out[40] = K(0.0);
    out[41] = K(0.0);
    out[42] = K(1.0);
    out[43] = K(0.0);
    out[44] = K(0.0);
    out[45] = K(0.0);
    out[46] = K(0.0);
    out[47] = K(1.0);
    out[48] = K(1.0);
    out[49] = K(0.0);
    out[50] = K(0.0);
    out[51] = K(0.0);
    out[52] = K(0.0);
    out[53] = K(1.0);
    out[54] = K(0.0);
    out[55] = K(0.0);
    out[56] = K(0.0);
    out[57] = K(0.0);
    out[58] = K(1.0);
    out[59] = K(0.0);
    out[60] = K(0.0);
    out[61] = K(0.0);
    out[62] = K(0.0);
    out[63] = K(1.0);
    out[64] = c[0];
    out[65] = -s[0];
    out[66] = K(0.0);
    out[67] = K(0.0);
    out[68] = s[0];
    out[69] = c[0];
    out[70] = K(0.0);
    out[71] = K(0.0);
    out[72] = K(0.0);
    out[73] = K(0.0);
    out[74] = K(1.0);
    out[75] = K(0.1452);
    out[76] = K(0.0);
    out[77] = K(0.0);
    out[78] = K(0.0);
    out[79] = K(1.0);
    out[80] = c[0];
    out[81] = -s[0];
    out[82] = K(0.0);
    out[83] = K(0.0);
    out[84] = s[0];
    out[85] = c[0];
    out[86] = K(0.0);
    out[87] = K(0.0);
    out[88] = K(0.0);
    out[89] = K(0.0);
    out[90] = K(1.0);
    out[91] = K(0.1452);
    out[92] = K(0.0);
    out[93] = K(0.0);
    out[94] = K(0.0);
    out[95] = K(1.0);
    out[96] = t0;
    out[97] = t1;
    out[98] = -s[0];
    out[99] = K(0.0);
    out[100] = t2;
    out[101] = t3;
    out[102] = c[0];
    out[103] = K(0.0);
    out[104] = c[1];
    out[105] = -s[1];
    out[106] = K(0.0);
    out[107] = K(0.1452);
    out[108] = K(0.0);
    out[109] = K(0.0);
    out[110] = K(0.0);
    out[111] = K(1.0);
    out[112] = t0;
    out[113] = t1;
    out[114] = -s[0];
    out[115] = K(0.0);
    out[116] = t2;
    out[117] = t3;
    out[118] = c[0];
    out[119] = K(0.0);
    out[120] = c[1];
    out[121] = -s[1];
    out[122] = K(0.0);
    out[123] = K(0.1452);
    out[124] = K(0.0);
    out[125] = K(0.0);
    out[126] = K(0.0);
    out[127] = K(1.0);
    out[128] = t6;
    out[129] = t9;
    out[130] = -s[0];
    out[131] = t10;
    out[132] = t13;
    out[133] = t16;
    out[134] = c[0];
    out[135] = t17;
    out[136] = t20;
    out[137] = -t23;
    out[138] = K(0.0);
    out[139] = t25;
    out[140] = K(0.0);
    out[141] = K(0.0);
    out[142] = K(0.0);
    out[143] = K(1.0);
    out[144] = t6;
    out[145] = t9;
    out[146] = -s[0];
    out[147] = t10;
    out[148] = t13;
    out[149] = t16;
    out[150] = c[0];
    out[151] = t17;
    out[152] = t20;
    out[153] = -t23;
    out[154] = K(0.0);
    out[155] = t25;
    out[156] = K(0.0);
    out[157] = K(0.0);
    out[158] = K(0.0);
    out[159] = K(1.0);
    out[160] = t28;
    out[161] = -t31;
    out[162] = -s[0];
    out[163] = t35;
    out[164] = t38;
    out[165] = -t41;
    out[166] = c[0];
    out[167] = t45;
    out[168] = -t48;
    out[169] = t51;
    out[170] = K(0.0);
    out[171] = t53;
    out[172] = K(0.0);
    out[173] = K(0.0);
    out[174] = K(0.0);
    out[175] = K(1.0);
    out[176] = t28;
    out[177] = -t31;
    out[178] = -s[0];
    out[179] = t35;
    out[180] = t38;
    out[181] = -t41;
    out[182] = c[0];
    out[183] = t45;
    out[184] = -t48;
    out[185] = t51;
    out[186] = K(0.0);
    out[187] = t53;
    out[188] = K(0.0);
    out[189] = K(0.0);
    out[190] = K(0.0);
    out[191] = K(1.0);
    out[192] = t56;
    out[193] = -t59;
    out[194] = t31;
    out[195] = t61;
    out[196] = t64;
    out[197] = t67;
    out[198] = t41;
    out[199] = t69;
    out[200] = -t70;
    out[201] = t71;
    out[202] = -t51;
    out[203] = t73;
    out[204] = K(0.0);
    out[205] = K(0.0);
    out[206] = K(0.0);
    out[207] = K(1.0);
    out[208] = t56;
    out[209] = -t59;
    out[210] = t31;
    out[211] = t61;
    out[212] = t64;
    out[213] = t67;
    out[214] = t41;
    out[215] = t69;
    out[216] = -t70;
    out[217] = t71;
    out[218] = -t51;
    out[219] = t73;
    out[220] = K(0.0);
    out[221] = K(0.0);
    out[222] = K(0.0);
    out[223] = K(1.0);
    out[224] = t76;
    out[225] = t79;
    out[226] = t59;
    out[227] = t81;
    out[228] = t84;
    out[229] = t87;
    out[230] = -t67;
    out[231] = t89;
    out[232] = -t92;
    out[233] = t95;
    out[234] = -t71;
    out[235] = t97;
    out[236] = K(0.0);
    out[237] = K(0.0);
    out[238] = K(0.0);
    out[239] = K(1.0);
    out[240] = t76;
    out[241] = t79;
    out[242] = t59;
    out[243] = t81;
    out[244] = t84;
    out[245] = t87;
    out[246] = -t67;
    out[247] = t89;
    out[248] = -t92;
    out[249] = t95;
    out[250] = -t71;
    out[251] = t97;
    out[252] = K(0.0);
    out[253] = K(0.0);
    out[254] = K(0.0);
    out[255] = K(1.0);
    out[256] = t76;
    out[257] = t79;
    out[258] = t59;
    out[259] = t81;
    out[260] = t84;
    out[261] = t87;
    out[262] = -t67;
    out[263] = t89;
    out[264] = -t92;
    out[265] = t95;
    out[266] = -t71;
    out[267] = t97;
    out[268] = K(0.0);
    out[269] = K(0.0);
    out[270] = K(0.0);
    out[271] = K(1.0);
    out[272] = t76;
    out[273] = t79;
    out[274] = t59;
    out[275] = t81;
    out[276] = t84;
    out[277] = t87;
    out[278] = -t67;
    out[279] = t89;
    out[280] = -t92;
    out[281] = t95;
    out[282] = -t71;
    out[283] = t97;
    out[284] = K(0.0);
    out[285] = K(0.0);
    out[286] = K(0.0);
    out[287] = K(1.0);
}

CGA_EXPORT int cga_tm5_700_tree_frames(const double *restrict q /* 6 */, double *restrict out /* 288 */)
{
    double c[6], s[6];
    for (int j = 0; j < 6; ++j) { c[j] = cos(q[j]); s[j] = sin(q[j]); }
    cga_tm5_700_tree_frames_body(c, s, out);
    return cga_not_finite(q, 6);
}

CGA_EXPORT int cga_tm5_700_tree_frames_batch(int64_t n, const double *restrict q /* 6 */, double *restrict out)
{
    int bad = 0;
    for (int64_t k = 0; k < n; ++k)
        bad |= cga_tm5_700_tree_frames(q + k * 6, out + k * 288);
    return bad;
}
