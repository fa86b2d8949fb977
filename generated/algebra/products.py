"""Products of conformal geometric algebra, straight from the exact tables.

Made by cga_codegen/emit/print_products.py; do not edit: cga generate
Components in ascending bit masks: e0 = 1, e1 = 2, e2 = 4, e3 = 8, ei = 16; e0.ei = -1.
Arguments are sequences of components (component axis first): floats, numpy arrays, Fractions, casadi.SX; results are tuples.
"""


def rotor_rotor(a, b):
    """a b: rotor and rotor to rotor (1 e12 e13 e23).

    16 mul, 12 add.
    """
    a0, a1, a2, a3 = a[0], a[1], a[2], a[3]
    b0, b1, b2, b3 = b[0], b[1], b[2], b[3]
    r0 = a0 * b0 - a1 * b1 - a2 * b2 - a3 * b3
    r1 = a0 * b1 + a1 * b0 - a2 * b3 + a3 * b2
    r2 = a0 * b2 + a1 * b3 + a2 * b0 - a3 * b1
    r3 = a0 * b3 - a1 * b2 + a2 * b1 + a3 * b0
    return r0, r1, r2, r3


def translator_rotor(a, b):
    """a b: translator and rotor to motor (1 e12 e13 e23 e1i e2i e3i e123i).

    16 mul, 8 add.
    """
    a0, a1, a2, a3 = a[0], a[1], a[2], a[3]
    b0, b1, b2, b3 = b[0], b[1], b[2], b[3]
    r0 = a0 * b0
    r1 = a0 * b1
    r2 = a0 * b2
    r3 = a0 * b3
    r4 = a1 * b0 - a2 * b1 - a3 * b2
    r5 = a1 * b1 + a2 * b0 - a3 * b3
    r6 = a1 * b2 + a2 * b3 + a3 * b0
    r7 = a1 * b3 - a2 * b2 + a3 * b1
    return r0, r1, r2, r3, r4, r5, r6, r7


def rotor_translator(a, b):
    """a b: rotor and translator to motor (1 e12 e13 e23 e1i e2i e3i e123i).

    16 mul, 8 add.
    """
    a0, a1, a2, a3 = a[0], a[1], a[2], a[3]
    b0, b1, b2, b3 = b[0], b[1], b[2], b[3]
    r0 = a0 * b0
    r1 = a1 * b0
    r2 = a2 * b0
    r3 = a3 * b0
    r4 = a0 * b1 + a1 * b2 + a2 * b3
    r5 = a0 * b2 - a1 * b1 + a3 * b3
    r6 = a0 * b3 - a2 * b1 - a3 * b2
    r7 = a1 * b3 - a2 * b2 + a3 * b1
    return r0, r1, r2, r3, r4, r5, r6, r7


def motor_translator(a, b):
    """a b: motor and translator to motor (1 e12 e13 e23 e1i e2i e3i e123i).

    20 mul, 12 add.
    """
    a0, a1, a2, a3, a4, a5, a6, a7 = a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7]
    b0, b1, b2, b3 = b[0], b[1], b[2], b[3]
    r0 = a0 * b0
    r1 = a1 * b0
    r2 = a2 * b0
    r3 = a3 * b0
    r4 = a0 * b1 + a1 * b2 + a2 * b3 + a4 * b0
    r5 = a0 * b2 - a1 * b1 + a3 * b3 + a5 * b0
    r6 = a0 * b3 - a2 * b1 - a3 * b2 + a6 * b0
    r7 = a1 * b3 - a2 * b2 + a3 * b1 + a7 * b0
    return r0, r1, r2, r3, r4, r5, r6, r7


def motor_rotor(a, b):
    """a b: motor and rotor to motor (1 e12 e13 e23 e1i e2i e3i e123i).

    32 mul, 24 add.
    """
    a0, a1, a2, a3, a4, a5, a6, a7 = a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7]
    b0, b1, b2, b3 = b[0], b[1], b[2], b[3]
    r0 = a0 * b0 - a1 * b1 - a2 * b2 - a3 * b3
    r1 = a0 * b1 + a1 * b0 - a2 * b3 + a3 * b2
    r2 = a0 * b2 + a1 * b3 + a2 * b0 - a3 * b1
    r3 = a0 * b3 - a1 * b2 + a2 * b1 + a3 * b0
    r4 = a4 * b0 - a5 * b1 - a6 * b2 - a7 * b3
    r5 = a4 * b1 + a5 * b0 - a6 * b3 + a7 * b2
    r6 = a4 * b2 + a5 * b3 + a6 * b0 - a7 * b1
    r7 = a4 * b3 - a5 * b2 + a6 * b1 + a7 * b0
    return r0, r1, r2, r3, r4, r5, r6, r7


def motor_motor(a, b):
    """a b: motor and motor to motor (1 e12 e13 e23 e1i e2i e3i e123i).

    48 mul, 40 add.
    """
    a0, a1, a2, a3, a4, a5, a6, a7 = a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7]
    b0, b1, b2, b3, b4, b5, b6, b7 = b[0], b[1], b[2], b[3], b[4], b[5], b[6], b[7]
    r0 = a0 * b0 - a1 * b1 - a2 * b2 - a3 * b3
    r1 = a0 * b1 + a1 * b0 - a2 * b3 + a3 * b2
    r2 = a0 * b2 + a1 * b3 + a2 * b0 - a3 * b1
    r3 = a0 * b3 - a1 * b2 + a2 * b1 + a3 * b0
    r4 = a0 * b4 + a1 * b5 + a2 * b6 - a3 * b7 + a4 * b0 - a5 * b1 - a6 * b2 - a7 * b3
    r5 = a0 * b5 - a1 * b4 + a2 * b7 + a3 * b6 + a4 * b1 + a5 * b0 - a6 * b3 + a7 * b2
    r6 = a0 * b6 - a1 * b7 - a2 * b4 - a3 * b5 + a4 * b2 + a5 * b3 + a6 * b0 - a7 * b1
    r7 = a0 * b7 + a1 * b6 - a2 * b5 + a3 * b4 + a4 * b3 - a5 * b2 + a6 * b1 + a7 * b0
    return r0, r1, r2, r3, r4, r5, r6, r7


def motor_dilator(a, b):
    """a b: motor and dilator to similarity (1 e12 e13 e23 e0i e1i e2i e012i e3i e013i e023i e123i).

    16 mul, 4 add.
    """
    a0, a1, a2, a3, a4, a5, a6, a7 = a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7]
    b0, b1 = b[0], b[1]
    r0 = a0 * b0
    r1 = a1 * b0
    r2 = a2 * b0
    r3 = a3 * b0
    r4 = a0 * b1
    r5 = a4 * b0 - a4 * b1
    r6 = a5 * b0 - a5 * b1
    r7 = a1 * b1
    r8 = a6 * b0 - a6 * b1
    r9 = a2 * b1
    r10 = a3 * b1
    r11 = a7 * b0 - a7 * b1
    return r0, r1, r2, r3, r4, r5, r6, r7, r8, r9, r10, r11


def motor_similarity(a, b):
    """a b: motor and similarity to similarity (1 e12 e13 e23 e0i e1i e2i e012i e3i e013i e023i e123i).

    80 mul, 68 add.
    """
    a0, a1, a2, a3, a4, a5, a6, a7 = a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7]
    b0, b1, b2, b3, b4, b5, b6, b7, b8, b9, b10, b11 = b[0], b[1], b[2], b[3], b[4], b[5], b[6], b[7], b[8], b[9], b[10], b[11]
    r0 = a0 * b0 - a1 * b1 - a2 * b2 - a3 * b3
    r1 = a0 * b1 + a1 * b0 - a2 * b3 + a3 * b2
    r2 = a0 * b2 + a1 * b3 + a2 * b0 - a3 * b1
    r3 = a0 * b3 - a1 * b2 + a2 * b1 + a3 * b0
    r4 = a0 * b4 - a1 * b7 - a2 * b9 - a3 * b10
    r5 = (a0 * b5 + a1 * b6 + a2 * b8 - a3 * b11 + a4 * b0 - a4 * b4 - a5 * b1 + a5 * b7 - a6 * b2 + a6 * b9
        - a7 * b3 + a7 * b10)
    r6 = (a0 * b6 - a1 * b5 + a2 * b11 + a3 * b8 + a4 * b1 - a4 * b7 + a5 * b0 - a5 * b4 - a6 * b3 + a6 * b10
        + a7 * b2 - a7 * b9)
    r7 = a0 * b7 + a1 * b4 - a2 * b10 + a3 * b9
    r8 = (a0 * b8 - a1 * b11 - a2 * b5 - a3 * b6 + a4 * b2 - a4 * b9 + a5 * b3 - a5 * b10 + a6 * b0 - a6 * b4
        - a7 * b1 + a7 * b7)
    r9 = a0 * b9 + a1 * b10 + a2 * b4 - a3 * b7
    r10 = a0 * b10 - a1 * b9 + a2 * b7 + a3 * b4
    r11 = (a0 * b11 + a1 * b8 - a2 * b6 + a3 * b5 + a4 * b3 - a4 * b10 - a5 * b2 + a5 * b9 + a6 * b1 - a6 * b7
        + a7 * b0 - a7 * b4)
    return r0, r1, r2, r3, r4, r5, r6, r7, r8, r9, r10, r11


def similarity_motor(a, b):
    """a b: similarity and motor to similarity (1 e12 e13 e23 e0i e1i e2i e012i e3i e013i e023i e123i).

    80 mul, 68 add.
    """
    a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11 = a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], a[9], a[10], a[11]
    b0, b1, b2, b3, b4, b5, b6, b7 = b[0], b[1], b[2], b[3], b[4], b[5], b[6], b[7]
    r0 = a0 * b0 - a1 * b1 - a2 * b2 - a3 * b3
    r1 = a0 * b1 + a1 * b0 - a2 * b3 + a3 * b2
    r2 = a0 * b2 + a1 * b3 + a2 * b0 - a3 * b1
    r3 = a0 * b3 - a1 * b2 + a2 * b1 + a3 * b0
    r4 = a4 * b0 - a7 * b1 - a9 * b2 - a10 * b3
    r5 = (a0 * b4 + a1 * b5 + a2 * b6 - a3 * b7 + a4 * b4 + a5 * b0 - a6 * b1 + a7 * b5 - a8 * b2 + a9 * b6
        - a10 * b7 - a11 * b3)
    r6 = (a0 * b5 - a1 * b4 + a2 * b7 + a3 * b6 + a4 * b5 + a5 * b1 + a6 * b0 - a7 * b4 - a8 * b3 + a9 * b7
        + a10 * b6 + a11 * b2)
    r7 = a4 * b1 + a7 * b0 - a9 * b3 + a10 * b2
    r8 = (a0 * b6 - a1 * b7 - a2 * b4 - a3 * b5 + a4 * b6 + a5 * b2 + a6 * b3 - a7 * b7 + a8 * b0 - a9 * b4
        - a10 * b5 - a11 * b1)
    r9 = a4 * b2 + a7 * b3 + a9 * b0 - a10 * b1
    r10 = a4 * b3 - a7 * b2 + a9 * b1 + a10 * b0
    r11 = (a0 * b7 + a1 * b6 - a2 * b5 + a3 * b4 + a4 * b7 + a5 * b3 - a6 * b2 + a7 * b6 + a8 * b1 - a9 * b5
        + a10 * b4 + a11 * b0)
    return r0, r1, r2, r3, r4, r5, r6, r7, r8, r9, r10, r11


def similarity_similarity(a, b):
    """a b: similarity and similarity to similarity (1 e12 e13 e23 e0i e1i e2i e012i e3i e013i e023i e123i).

    128 mul, 116 add.
    """
    a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11 = a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], a[9], a[10], a[11]
    b0, b1, b2, b3, b4, b5, b6, b7, b8, b9, b10, b11 = b[0], b[1], b[2], b[3], b[4], b[5], b[6], b[7], b[8], b[9], b[10], b[11]
    r0 = a0 * b0 - a1 * b1 - a2 * b2 - a3 * b3 + a4 * b4 - a7 * b7 - a9 * b9 - a10 * b10
    r1 = a0 * b1 + a1 * b0 - a2 * b3 + a3 * b2 + a4 * b7 + a7 * b4 - a9 * b10 + a10 * b9
    r2 = a0 * b2 + a1 * b3 + a2 * b0 - a3 * b1 + a4 * b9 + a7 * b10 + a9 * b4 - a10 * b7
    r3 = a0 * b3 - a1 * b2 + a2 * b1 + a3 * b0 + a4 * b10 - a7 * b9 + a9 * b7 + a10 * b4
    r4 = a0 * b4 - a1 * b7 - a2 * b9 - a3 * b10 + a4 * b0 - a7 * b1 - a9 * b2 - a10 * b3
    r5 = (a0 * b5 + a1 * b6 + a2 * b8 - a3 * b11 + a4 * b5 + a5 * b0 - a5 * b4 - a6 * b1 + a6 * b7 + a7 * b6
        - a8 * b2 + a8 * b9 + a9 * b8 - a10 * b11 - a11 * b3 + a11 * b10)
    r6 = (a0 * b6 - a1 * b5 + a2 * b11 + a3 * b8 + a4 * b6 + a5 * b1 - a5 * b7 + a6 * b0 - a6 * b4 - a7 * b5
        - a8 * b3 + a8 * b10 + a9 * b11 + a10 * b8 + a11 * b2 - a11 * b9)
    r7 = a0 * b7 + a1 * b4 - a2 * b10 + a3 * b9 + a4 * b1 + a7 * b0 - a9 * b3 + a10 * b2
    r8 = (a0 * b8 - a1 * b11 - a2 * b5 - a3 * b6 + a4 * b8 + a5 * b2 - a5 * b9 + a6 * b3 - a6 * b10 - a7 * b11
        + a8 * b0 - a8 * b4 - a9 * b5 - a10 * b6 - a11 * b1 + a11 * b7)
    r9 = a0 * b9 + a1 * b10 + a2 * b4 - a3 * b7 + a4 * b2 + a7 * b3 + a9 * b0 - a10 * b1
    r10 = a0 * b10 - a1 * b9 + a2 * b7 + a3 * b4 + a4 * b3 - a7 * b2 + a9 * b1 + a10 * b0
    r11 = (a0 * b11 + a1 * b8 - a2 * b6 + a3 * b5 + a4 * b11 + a5 * b3 - a5 * b10 - a6 * b2 + a6 * b9 + a7 * b8
        + a8 * b1 - a8 * b7 - a9 * b6 + a10 * b5 + a11 * b0 - a11 * b4)
    return r0, r1, r2, r3, r4, r5, r6, r7, r8, r9, r10, r11


def outer_point_point(a, b):
    """a ^ b: point and point to point_pair (e01 e02 e12 e03 e13 e23 e0i e1i e2i e3i).

    20 mul, 10 add.
    """
    a0, a1, a2, a3, a4 = a[0], a[1], a[2], a[3], a[4]
    b0, b1, b2, b3, b4 = b[0], b[1], b[2], b[3], b[4]
    r0 = a0 * b1 - a1 * b0
    r1 = a0 * b2 - a2 * b0
    r2 = a1 * b2 - a2 * b1
    r3 = a0 * b3 - a3 * b0
    r4 = a1 * b3 - a3 * b1
    r5 = a2 * b3 - a3 * b2
    r6 = a0 * b4 - a4 * b0
    r7 = a1 * b4 - a4 * b1
    r8 = a2 * b4 - a4 * b2
    r9 = a3 * b4 - a4 * b3
    return r0, r1, r2, r3, r4, r5, r6, r7, r8, r9


def outer_point_pair_point(a, b):
    """a ^ b: point_pair and point to circle (e012 e013 e023 e123 e01i e02i e12i e03i e13i e23i).

    30 mul, 20 add.
    """
    a0, a1, a2, a3, a4, a5, a6, a7, a8, a9 = a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], a[9]
    b0, b1, b2, b3, b4 = b[0], b[1], b[2], b[3], b[4]
    r0 = a0 * b2 - a1 * b1 + a2 * b0
    r1 = a0 * b3 - a3 * b1 + a4 * b0
    r2 = a1 * b3 - a3 * b2 + a5 * b0
    r3 = a2 * b3 - a4 * b2 + a5 * b1
    r4 = a0 * b4 - a6 * b1 + a7 * b0
    r5 = a1 * b4 - a6 * b2 + a8 * b0
    r6 = a2 * b4 - a7 * b2 + a8 * b1
    r7 = a3 * b4 - a6 * b3 + a9 * b0
    r8 = a4 * b4 - a7 * b3 + a9 * b1
    r9 = a5 * b4 - a8 * b3 + a9 * b2
    return r0, r1, r2, r3, r4, r5, r6, r7, r8, r9


def outer_circle_point(a, b):
    """a ^ b: circle and point to sphere (e0123 e012i e013i e023i e123i).

    20 mul, 15 add.
    """
    a0, a1, a2, a3, a4, a5, a6, a7, a8, a9 = a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], a[9]
    b0, b1, b2, b3, b4 = b[0], b[1], b[2], b[3], b[4]
    r0 = a0 * b3 - a1 * b2 + a2 * b1 - a3 * b0
    r1 = a0 * b4 - a4 * b2 + a5 * b1 - a6 * b0
    r2 = a1 * b4 - a4 * b3 + a7 * b1 - a8 * b0
    r3 = a2 * b4 - a5 * b3 + a7 * b2 - a9 * b0
    r4 = a3 * b4 - a6 * b3 + a8 * b2 - a9 * b1
    return r0, r1, r2, r3, r4


def sandwich_motor_origin(a, b):
    """a b ~a: motor and origin to point (e0 e1 e2 e3 ei).

    48 mul, 31 add.
    """
    a0, a1, a2, a3, a4, a5, a6, a7 = a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7]
    b0 = b[0]
    m0 = a0 * b0
    m1 = -a4 * b0
    m2 = -a5 * b0
    m3 = a1 * b0
    m4 = -a6 * b0
    m5 = a2 * b0
    m6 = a3 * b0
    m7 = -a7 * b0
    m8 = a4 * b0
    m9 = a5 * b0
    m10 = a6 * b0
    m11 = a7 * b0
    r0 = m0 * a0 + m3 * a1 + m5 * a2 + m6 * a3
    r1 = -m0 * a4 + m1 * a0 + m2 * a1 - m3 * a5 + m4 * a2 - m5 * a6 - m6 * a7 + m7 * a3
    r2 = -m0 * a5 - m1 * a1 + m2 * a0 + m3 * a4 + m4 * a3 + m5 * a7 - m6 * a6 - m7 * a2
    r3 = -m0 * a6 - m1 * a2 - m2 * a3 - m3 * a7 + m4 * a0 + m5 * a4 + m6 * a5 + m7 * a1
    r4 = -m1 * a4 - m2 * a5 - m4 * a6 - m7 * a7 + m8 * a4 + m9 * a5 + m10 * a6 + m11 * a7
    return r0, r1, r2, r3, r4


def sandwich_motor_point(a, b):
    """a b ~a: motor and point to point (e0 e1 e2 e3 ei).

    80 mul, 59 add.
    """
    a0, a1, a2, a3, a4, a5, a6, a7 = a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7]
    b0, b1, b2, b3, b4 = b[0], b[1], b[2], b[3], b[4]
    m0 = a0 * b0
    m1 = a0 * b1 + a1 * b2 + a2 * b3 - a4 * b0
    m2 = a0 * b2 - a1 * b1 + a3 * b3 - a5 * b0
    m3 = a1 * b0
    m4 = a0 * b3 - a2 * b1 - a3 * b2 - a6 * b0
    m5 = a2 * b0
    m6 = a3 * b0
    m7 = a1 * b3 - a2 * b2 + a3 * b1 - a7 * b0
    m8 = a0 * b4 - a4 * b1 - a5 * b2 - a6 * b3
    m9 = a4 * b0
    m10 = a5 * b0
    m11 = a1 * b4 - a4 * b2 + a5 * b1 - a7 * b3
    m12 = a6 * b0
    m13 = a2 * b4 - a4 * b3 + a6 * b1 + a7 * b2
    m14 = a3 * b4 - a5 * b3 + a6 * b2 - a7 * b1
    m15 = a7 * b0
    r0 = m0 * a0 + m3 * a1 + m5 * a2 + m6 * a3
    r1 = -m0 * a4 + m1 * a0 + m2 * a1 - m3 * a5 + m4 * a2 - m5 * a6 - m6 * a7 + m7 * a3
    r2 = -m0 * a5 - m1 * a1 + m2 * a0 + m3 * a4 + m4 * a3 + m5 * a7 - m6 * a6 - m7 * a2
    r3 = -m0 * a6 - m1 * a2 - m2 * a3 - m3 * a7 + m4 * a0 + m5 * a4 + m6 * a5 + m7 * a1
    r4 = (-m1 * a4 - m2 * a5 - m4 * a6 - m7 * a7 + m8 * a0 + m9 * a4 + m10 * a5 + m11 * a1 + m12 * a6 + m13 * a2
        + m14 * a3 + m15 * a7)
    return r0, r1, r2, r3, r4


def sandwich_motor_line(a, b):
    """a b ~a: motor and line to line (e01i e02i e12i e03i e13i e23i).

    72 mul, 58 add.
    """
    a0, a1, a2, a3, a4, a5, a6, a7 = a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7]
    b0, b1, b2, b3, b4, b5 = b[0], b[1], b[2], b[3], b[4], b[5]
    m0 = -a1 * b2 - a2 * b4 - a3 * b5 - a4 * b0 - a5 * b1 - a6 * b3
    m1 = a0 * b0 + a1 * b1 + a2 * b3
    m2 = a0 * b1 - a1 * b0 + a3 * b3
    m3 = a0 * b2 - a2 * b5 + a3 * b4 - a4 * b1 + a5 * b0 - a7 * b3
    m4 = a0 * b3 - a2 * b0 - a3 * b1
    m5 = a0 * b4 + a1 * b5 - a3 * b2 - a4 * b3 + a6 * b0 + a7 * b1
    m6 = a0 * b5 - a1 * b4 + a2 * b2 - a5 * b3 + a6 * b1 - a7 * b0
    m7 = a1 * b3 - a2 * b1 + a3 * b0
    r0 = m1 * a0 + m2 * a1 + m4 * a2 + m7 * a3
    r1 = -m1 * a1 + m2 * a0 + m4 * a3 - m7 * a2
    r2 = -m0 * a1 + m1 * a5 - m2 * a4 + m3 * a0 - m4 * a7 + m5 * a3 - m6 * a2 + m7 * a6
    r3 = -m1 * a2 - m2 * a3 + m4 * a0 + m7 * a1
    r4 = -m0 * a2 + m1 * a6 + m2 * a7 - m3 * a3 - m4 * a4 + m5 * a0 + m6 * a1 - m7 * a5
    r5 = -m0 * a3 - m1 * a7 + m2 * a6 + m3 * a2 - m4 * a5 - m5 * a1 + m6 * a0 + m7 * a4
    return r0, r1, r2, r3, r4, r5


def sandwich_motor_plane(a, b):
    """a b ~a: motor and plane to plane (e012i e013i e023i e123i).

    48 mul, 36 add.
    """
    a0, a1, a2, a3, a4, a5, a6, a7 = a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7]
    b0, b1, b2, b3 = b[0], b[1], b[2], b[3]
    m0 = -a1 * b0 - a2 * b1 - a3 * b2
    m1 = -a3 * b3 + a5 * b0 + a6 * b1 + a7 * b2
    m2 = a2 * b3 - a4 * b0 + a6 * b2 - a7 * b1
    m3 = a0 * b0 - a2 * b2 + a3 * b1
    m4 = -a1 * b3 - a4 * b1 - a5 * b2 + a7 * b0
    m5 = a0 * b1 + a1 * b2 - a3 * b0
    m6 = a0 * b2 - a1 * b1 + a2 * b0
    m7 = a0 * b3 - a4 * b2 + a5 * b1 - a6 * b0
    r0 = -m0 * a1 + m3 * a0 + m5 * a3 - m6 * a2
    r1 = -m0 * a2 - m3 * a3 + m5 * a0 + m6 * a1
    r2 = -m0 * a3 + m3 * a2 - m5 * a1 + m6 * a0
    r3 = m0 * a7 - m1 * a3 + m2 * a2 - m3 * a6 - m4 * a1 + m5 * a5 - m6 * a4 + m7 * a0
    return r0, r1, r2, r3


def sandwich_motor_point_pair(a, b):
    """a b ~a: motor and point_pair to point_pair (e01 e02 e12 e03 e13 e23 e0i e1i e2i e3i).

    160 mul, 134 add.
    """
    a0, a1, a2, a3, a4, a5, a6, a7 = a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7]
    b0, b1, b2, b3, b4, b5, b6, b7, b8, b9 = b[0], b[1], b[2], b[3], b[4], b[5], b[6], b[7], b[8], b[9]
    m0 = -a1 * b2 - a2 * b4 - a3 * b5 - a4 * b0 - a5 * b1 - a6 * b3
    m1 = a0 * b0 + a1 * b1 + a2 * b3
    m2 = a0 * b1 - a1 * b0 + a3 * b3
    m3 = a0 * b2 - a2 * b5 + a3 * b4 - a4 * b1 + a5 * b0 - a7 * b3
    m4 = a0 * b3 - a2 * b0 - a3 * b1
    m5 = a0 * b4 + a1 * b5 - a3 * b2 - a4 * b3 + a6 * b0 + a7 * b1
    m6 = a0 * b5 - a1 * b4 + a2 * b2 - a5 * b3 + a6 * b1 - a7 * b0
    m7 = a1 * b3 - a2 * b1 + a3 * b0
    m8 = a0 * b6 - a4 * b0 - a5 * b1 - a6 * b3
    m9 = a0 * b7 + a1 * b8 + a2 * b9 - a4 * b6 - a5 * b2 - a6 * b4 - a7 * b5
    m10 = a0 * b8 - a1 * b7 + a3 * b9 + a4 * b2 - a5 * b6 - a6 * b5 + a7 * b4
    m11 = a1 * b6 - a4 * b1 + a5 * b0 - a7 * b3
    m12 = a0 * b9 - a2 * b7 - a3 * b8 + a4 * b4 + a5 * b5 - a6 * b6 - a7 * b2
    m13 = a2 * b6 - a4 * b3 + a6 * b0 + a7 * b1
    m14 = a3 * b6 - a5 * b3 + a6 * b1 - a7 * b0
    m15 = a1 * b9 - a2 * b8 + a3 * b7 + a4 * b5 - a5 * b4 + a6 * b2 - a7 * b6
    r0 = m1 * a0 + m2 * a1 + m4 * a2 + m7 * a3
    r1 = -m1 * a1 + m2 * a0 + m4 * a3 - m7 * a2
    r2 = -m0 * a1 + m1 * a5 - m2 * a4 + m3 * a0 - m4 * a7 + m5 * a3 - m6 * a2 + m7 * a6
    r3 = -m1 * a2 - m2 * a3 + m4 * a0 + m7 * a1
    r4 = -m0 * a2 + m1 * a6 + m2 * a7 - m3 * a3 - m4 * a4 + m5 * a0 + m6 * a1 - m7 * a5
    r5 = -m0 * a3 - m1 * a7 + m2 * a6 + m3 * a2 - m4 * a5 - m5 * a1 + m6 * a0 + m7 * a4
    r6 = -m1 * a4 - m2 * a5 - m4 * a6 - m7 * a7 + m8 * a0 + m11 * a1 + m13 * a2 + m14 * a3
    r7 = (-m0 * a4 - m3 * a5 - m5 * a6 - m6 * a7 - m8 * a4 + m9 * a0 + m10 * a1 - m11 * a5 + m12 * a2 - m13 * a6
        - m14 * a7 + m15 * a3)
    r8 = (-m0 * a5 + m3 * a4 + m5 * a7 - m6 * a6 - m8 * a5 - m9 * a1 + m10 * a0 + m11 * a4 + m12 * a3 + m13 * a7
        - m14 * a6 - m15 * a2)
    r9 = (-m0 * a6 - m3 * a7 + m5 * a4 + m6 * a5 - m8 * a6 - m9 * a2 - m10 * a3 - m11 * a7 + m12 * a0 + m13 * a4
        + m14 * a5 + m15 * a1)
    return r0, r1, r2, r3, r4, r5, r6, r7, r8, r9


def sandwich_motor_circle(a, b):
    """a b ~a: motor and circle to circle (e012 e013 e023 e123 e01i e02i e12i e03i e13i e23i).

    160 mul, 134 add.
    """
    a0, a1, a2, a3, a4, a5, a6, a7 = a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7]
    b0, b1, b2, b3, b4, b5, b6, b7, b8, b9 = b[0], b[1], b[2], b[3], b[4], b[5], b[6], b[7], b[8], b[9]
    m0 = -a1 * b0 - a2 * b1 - a3 * b2
    m1 = -a3 * b3 + a5 * b0 + a6 * b1 + a7 * b2
    m2 = a2 * b3 - a4 * b0 + a6 * b2 - a7 * b1
    m3 = a0 * b0 - a2 * b2 + a3 * b1
    m4 = -a1 * b3 - a4 * b1 - a5 * b2 + a7 * b0
    m5 = a0 * b1 + a1 * b2 - a3 * b0
    m6 = a0 * b2 - a1 * b1 + a2 * b0
    m7 = a0 * b3 - a4 * b2 + a5 * b1 - a6 * b0
    m8 = -a1 * b6 - a2 * b8 - a3 * b9 - a4 * b4 - a5 * b5 - a6 * b7 + a7 * b3
    m9 = a0 * b4 + a1 * b5 + a2 * b7 - a5 * b0 - a6 * b1 - a7 * b2
    m10 = a0 * b5 - a1 * b4 + a3 * b7 + a4 * b0 - a6 * b2 + a7 * b1
    m11 = a0 * b6 - a2 * b9 + a3 * b8 - a4 * b5 + a5 * b4 - a6 * b3 - a7 * b7
    m12 = a0 * b7 - a2 * b4 - a3 * b5 + a4 * b1 + a5 * b2 - a7 * b0
    m13 = a0 * b8 + a1 * b9 - a3 * b6 - a4 * b7 + a5 * b3 + a6 * b4 + a7 * b5
    m14 = a0 * b9 - a1 * b8 + a2 * b6 - a4 * b3 - a5 * b7 + a6 * b5 - a7 * b4
    m15 = a1 * b7 - a2 * b5 + a3 * b4 + a4 * b2 - a5 * b1 + a6 * b0
    r0 = -m0 * a1 + m3 * a0 + m5 * a3 - m6 * a2
    r1 = -m0 * a2 - m3 * a3 + m5 * a0 + m6 * a1
    r2 = -m0 * a3 + m3 * a2 - m5 * a1 + m6 * a0
    r3 = m0 * a7 - m1 * a3 + m2 * a2 - m3 * a6 - m4 * a1 + m5 * a5 - m6 * a4 + m7 * a0
    r4 = -m0 * a4 - m3 * a5 - m5 * a6 - m6 * a7 + m9 * a0 + m10 * a1 + m12 * a2 + m15 * a3
    r5 = -m0 * a5 + m3 * a4 + m5 * a7 - m6 * a6 - m9 * a1 + m10 * a0 + m12 * a3 - m15 * a2
    r6 = (-m1 * a5 + m2 * a4 + m4 * a7 - m7 * a6 - m8 * a1 + m9 * a5 - m10 * a4 + m11 * a0 - m12 * a7 + m13 * a3
        - m14 * a2 + m15 * a6)
    r7 = -m0 * a6 - m3 * a7 + m5 * a4 + m6 * a5 - m9 * a2 - m10 * a3 + m12 * a0 + m15 * a1
    r8 = (-m1 * a6 - m2 * a7 + m4 * a4 + m7 * a5 - m8 * a2 + m9 * a6 + m10 * a7 - m11 * a3 - m12 * a4 + m13 * a0
        + m14 * a1 - m15 * a5)
    r9 = (m1 * a7 - m2 * a6 + m4 * a5 - m7 * a4 - m8 * a3 - m9 * a7 + m10 * a6 + m11 * a2 - m12 * a5 - m13 * a1
        + m14 * a0 + m15 * a4)
    return r0, r1, r2, r3, r4, r5, r6, r7, r8, r9


def sandwich_motor_sphere(a, b):
    """a b ~a: motor and sphere to sphere (e0123 e012i e013i e023i e123i).

    80 mul, 59 add.
    """
    a0, a1, a2, a3, a4, a5, a6, a7 = a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7]
    b0, b1, b2, b3, b4 = b[0], b[1], b[2], b[3], b[4]
    m0 = a7 * b0
    m1 = -a3 * b0
    m2 = a2 * b0
    m3 = -a6 * b0
    m4 = -a1 * b0
    m5 = a5 * b0
    m6 = -a4 * b0
    m7 = a0 * b0
    m8 = -a1 * b1 - a2 * b2 - a3 * b3 + a7 * b0
    m9 = -a3 * b4 + a5 * b1 + a6 * b2 + a7 * b3
    m10 = a2 * b4 - a4 * b1 + a6 * b3 - a7 * b2
    m11 = a0 * b1 - a2 * b3 + a3 * b2 - a6 * b0
    m12 = -a1 * b4 - a4 * b2 - a5 * b3 + a7 * b1
    m13 = a0 * b2 + a1 * b3 - a3 * b1 + a5 * b0
    m14 = a0 * b3 - a1 * b2 + a2 * b1 - a4 * b0
    m15 = a0 * b4 - a4 * b3 + a5 * b2 - a6 * b1
    r0 = -m1 * a3 + m2 * a2 - m4 * a1 + m7 * a0
    r1 = -m1 * a5 + m2 * a4 + m4 * a7 - m7 * a6 - m8 * a1 + m11 * a0 + m13 * a3 - m14 * a2
    r2 = -m1 * a6 - m2 * a7 + m4 * a4 + m7 * a5 - m8 * a2 - m11 * a3 + m13 * a0 + m14 * a1
    r3 = m1 * a7 - m2 * a6 + m4 * a5 - m7 * a4 - m8 * a3 + m11 * a2 - m13 * a1 + m14 * a0
    r4 = (m0 * a7 - m3 * a6 + m5 * a5 - m6 * a4 + m8 * a7 - m9 * a3 + m10 * a2 - m11 * a6 - m12 * a1 + m13 * a5
        - m14 * a4 + m15 * a0)
    return r0, r1, r2, r3, r4


def sandwich_motor_similarity_bivector(a, b):
    """a b ~a: motor and similarity_bivector to similarity_bivector (e12 e13 e23 e0i e1i e2i e3i).

    96 mul, 77 add.
    """
    a0, a1, a2, a3, a4, a5, a6, a7 = a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7]
    b0, b1, b2, b3, b4, b5, b6 = b[0], b[1], b[2], b[3], b[4], b[5], b[6]
    m0 = -a1 * b0 - a2 * b1 - a3 * b2
    m1 = a0 * b0 - a2 * b2 + a3 * b1
    m2 = a0 * b1 + a1 * b2 - a3 * b0
    m3 = a0 * b2 - a1 * b1 + a2 * b0
    m4 = a0 * b3
    m5 = a0 * b4 + a1 * b5 + a2 * b6 - a4 * b3 - a5 * b0 - a6 * b1 - a7 * b2
    m6 = a0 * b5 - a1 * b4 + a3 * b6 + a4 * b0 - a5 * b3 - a6 * b2 + a7 * b1
    m7 = a1 * b3
    m8 = a0 * b6 - a2 * b4 - a3 * b5 + a4 * b1 + a5 * b2 - a6 * b3 - a7 * b0
    m9 = a2 * b3
    m10 = a3 * b3
    m11 = a1 * b6 - a2 * b5 + a3 * b4 + a4 * b2 - a5 * b1 + a6 * b0 - a7 * b3
    r0 = -m0 * a1 + m1 * a0 + m2 * a3 - m3 * a2
    r1 = -m0 * a2 - m1 * a3 + m2 * a0 + m3 * a1
    r2 = -m0 * a3 + m1 * a2 - m2 * a1 + m3 * a0
    r3 = m4 * a0 + m7 * a1 + m9 * a2 + m10 * a3
    r4 = (-m0 * a4 - m1 * a5 - m2 * a6 - m3 * a7 - m4 * a4 + m5 * a0 + m6 * a1 - m7 * a5 + m8 * a2 - m9 * a6
        - m10 * a7 + m11 * a3)
    r5 = (-m0 * a5 + m1 * a4 + m2 * a7 - m3 * a6 - m4 * a5 - m5 * a1 + m6 * a0 + m7 * a4 + m8 * a3 + m9 * a7
        - m10 * a6 - m11 * a2)
    r6 = (-m0 * a6 - m1 * a7 + m2 * a4 + m3 * a5 - m4 * a6 - m5 * a2 - m6 * a3 - m7 * a7 + m8 * a0 + m9 * a4
        + m10 * a5 + m11 * a1)
    return r0, r1, r2, r3, r4, r5, r6


def sandwich_similarity_point(a, b):
    """a b ~a: similarity and point to point (e0 e1 e2 e3 ei).

    120 mul, 99 add.
    """
    a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11 = a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], a[9], a[10], a[11]
    b0, b1, b2, b3, b4 = b[0], b[1], b[2], b[3], b[4]
    m0 = a0 * b0 - a4 * b0
    m1 = a0 * b1 + a1 * b2 + a2 * b3 - a5 * b0
    m2 = a0 * b2 - a1 * b1 + a3 * b3 - a6 * b0
    m3 = a1 * b0 - a7 * b0
    m4 = a0 * b3 - a2 * b1 - a3 * b2 - a8 * b0
    m5 = a2 * b0 - a9 * b0
    m6 = a3 * b0 - a10 * b0
    m7 = a1 * b3 - a2 * b2 + a3 * b1 - a11 * b0
    m8 = a0 * b4 + a4 * b4 - a5 * b1 - a6 * b2 - a8 * b3
    m9 = -a4 * b1 + a5 * b0 - a7 * b2 - a9 * b3
    m10 = -a4 * b2 + a6 * b0 + a7 * b1 - a10 * b3
    m11 = a1 * b4 - a5 * b2 + a6 * b1 + a7 * b4 - a11 * b3
    m12 = -a4 * b3 + a8 * b0 + a9 * b1 + a10 * b2
    m13 = a2 * b4 - a5 * b3 + a8 * b1 + a9 * b4 + a11 * b2
    m14 = a3 * b4 - a6 * b3 + a8 * b2 + a10 * b4 - a11 * b1
    m15 = -a7 * b3 + a9 * b2 - a10 * b1 + a11 * b0
    r0 = m0 * a0 - m0 * a4 + m3 * a1 - m3 * a7 + m5 * a2 - m5 * a9 + m6 * a3 - m6 * a10
    r1 = (-m0 * a5 + m1 * a0 + m2 * a1 - m3 * a6 + m4 * a2 - m5 * a8 - m6 * a11 + m7 * a3 + m9 * a4 + m10 * a7
        + m12 * a9 + m15 * a10)
    r2 = (-m0 * a6 - m1 * a1 + m2 * a0 + m3 * a5 + m4 * a3 + m5 * a11 - m6 * a8 - m7 * a2 - m9 * a7 + m10 * a4
        + m12 * a10 - m15 * a9)
    r3 = (-m0 * a8 - m1 * a2 - m2 * a3 - m3 * a11 + m4 * a0 + m5 * a5 + m6 * a6 + m7 * a1 - m9 * a9 - m10 * a10
        + m12 * a4 + m15 * a7)
    r4 = (-m1 * a5 - m2 * a6 - m4 * a8 - m7 * a11 + m8 * a0 + m8 * a4 + m9 * a5 + m10 * a6 + m11 * a1 + m11 * a7
        + m12 * a8 + m13 * a2 + m13 * a9 + m14 * a3 + m14 * a10 + m15 * a11)
    return r0, r1, r2, r3, r4


def sandwich_similarity_line(a, b):
    """a b ~a: similarity and line to line (e01i e02i e12i e03i e13i e23i).

    132 mul, 114 add.
    """
    a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11 = a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], a[9], a[10], a[11]
    b0, b1, b2, b3, b4, b5 = b[0], b[1], b[2], b[3], b[4], b[5]
    m0 = -a4 * b0 - a7 * b1 - a9 * b3
    m1 = -a4 * b1 + a7 * b0 - a10 * b3
    m2 = -a4 * b3 + a9 * b0 + a10 * b1
    m3 = -a7 * b3 + a9 * b1 - a10 * b0
    m4 = -a1 * b2 - a2 * b4 - a3 * b5 - a5 * b0 - a6 * b1 - a7 * b2 - a8 * b3 - a9 * b4 - a10 * b5
    m5 = a0 * b0 + a1 * b1 + a2 * b3
    m6 = a0 * b1 - a1 * b0 + a3 * b3
    m7 = a0 * b2 - a2 * b5 + a3 * b4 + a4 * b2 - a5 * b1 + a6 * b0 - a9 * b5 + a10 * b4 - a11 * b3
    m8 = a0 * b3 - a2 * b0 - a3 * b1
    m9 = a0 * b4 + a1 * b5 - a3 * b2 + a4 * b4 - a5 * b3 + a7 * b5 + a8 * b0 - a10 * b2 + a11 * b1
    m10 = a0 * b5 - a1 * b4 + a2 * b2 + a4 * b5 - a6 * b3 - a7 * b4 + a8 * b1 + a9 * b2 - a11 * b0
    m11 = a1 * b3 - a2 * b1 + a3 * b0
    r0 = m0 * a4 + m1 * a7 + m2 * a9 + m3 * a10 + m5 * a0 + m6 * a1 + m8 * a2 + m11 * a3
    r1 = -m0 * a7 + m1 * a4 + m2 * a10 - m3 * a9 - m5 * a1 + m6 * a0 + m8 * a3 - m11 * a2
    r2 = (-m0 * a6 + m1 * a5 + m2 * a11 - m3 * a8 - m4 * a1 - m4 * a7 + m5 * a6 - m6 * a5 + m7 * a0 + m7 * a4
        - m8 * a11 + m9 * a3 + m9 * a10 - m10 * a2 - m10 * a9 + m11 * a8)
    r3 = -m0 * a9 - m1 * a10 + m2 * a4 + m3 * a7 - m5 * a2 - m6 * a3 + m8 * a0 + m11 * a1
    r4 = (-m0 * a8 - m1 * a11 + m2 * a5 + m3 * a6 - m4 * a2 - m4 * a9 + m5 * a8 + m6 * a11 - m7 * a3 - m7 * a10
        - m8 * a5 + m9 * a0 + m9 * a4 + m10 * a1 + m10 * a7 - m11 * a6)
    r5 = (m0 * a11 - m1 * a8 + m2 * a6 - m3 * a5 - m4 * a3 - m4 * a10 - m5 * a11 + m6 * a8 + m7 * a2 + m7 * a9
        - m8 * a6 - m9 * a1 - m9 * a7 + m10 * a0 + m10 * a4 + m11 * a5)
    return r0, r1, r2, r3, r4, r5


def sandwich_similarity_plane(a, b):
    """a b ~a: similarity and plane to plane (e012i e013i e023i e123i).

    84 mul, 68 add.
    """
    a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11 = a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], a[9], a[10], a[11]
    b0, b1, b2, b3 = b[0], b[1], b[2], b[3]
    m0 = -a7 * b0 - a9 * b1 - a10 * b2
    m1 = a4 * b0 - a9 * b2 + a10 * b1
    m2 = a4 * b1 + a7 * b2 - a10 * b0
    m3 = a4 * b2 - a7 * b1 + a9 * b0
    m4 = -a1 * b0 - a2 * b1 - a3 * b2
    m5 = -a3 * b3 + a6 * b0 + a8 * b1 - a10 * b3 + a11 * b2
    m6 = a2 * b3 - a5 * b0 + a8 * b2 + a9 * b3 - a11 * b1
    m7 = a0 * b0 - a2 * b2 + a3 * b1
    m8 = -a1 * b3 - a5 * b1 - a6 * b2 - a7 * b3 + a11 * b0
    m9 = a0 * b1 + a1 * b2 - a3 * b0
    m10 = a0 * b2 - a1 * b1 + a2 * b0
    m11 = a0 * b3 + a4 * b3 - a5 * b2 + a6 * b1 - a8 * b0
    r0 = m0 * a7 - m1 * a4 - m2 * a10 + m3 * a9 - m4 * a1 + m7 * a0 + m9 * a3 - m10 * a2
    r1 = m0 * a9 + m1 * a10 - m2 * a4 - m3 * a7 - m4 * a2 - m7 * a3 + m9 * a0 + m10 * a1
    r2 = m0 * a10 - m1 * a9 + m2 * a7 - m3 * a4 - m4 * a3 + m7 * a2 - m9 * a1 + m10 * a0
    r3 = (m0 * a11 - m1 * a8 + m2 * a6 - m3 * a5 + m4 * a11 - m5 * a3 - m5 * a10 + m6 * a2 + m6 * a9 - m7 * a8
        - m8 * a1 - m8 * a7 + m9 * a6 - m10 * a5 + m11 * a0 + m11 * a4)
    return r0, r1, r2, r3


def sandwich_similarity_point_pair(a, b):
    """a b ~a: similarity and point_pair to point_pair (e01 e02 e12 e03 e13 e23 e0i e1i e2i e3i).

    240 mul, 214 add.
    """
    a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11 = a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], a[9], a[10], a[11]
    b0, b1, b2, b3, b4, b5, b6, b7, b8, b9 = b[0], b[1], b[2], b[3], b[4], b[5], b[6], b[7], b[8], b[9]
    m0 = -a1 * b2 - a2 * b4 - a3 * b5 + a4 * b6 - a5 * b0 - a6 * b1 - a8 * b3
    m1 = a0 * b0 + a1 * b1 + a2 * b3 - a4 * b0 - a7 * b1 - a9 * b3
    m2 = a0 * b1 - a1 * b0 + a3 * b3 - a4 * b1 + a7 * b0 - a10 * b3
    m3 = a0 * b2 - a2 * b5 + a3 * b4 - a5 * b1 + a6 * b0 + a7 * b6 - a11 * b3
    m4 = a0 * b3 - a2 * b0 - a3 * b1 - a4 * b3 + a9 * b0 + a10 * b1
    m5 = a0 * b4 + a1 * b5 - a3 * b2 - a5 * b3 + a8 * b0 + a9 * b6 + a11 * b1
    m6 = a0 * b5 - a1 * b4 + a2 * b2 - a6 * b3 + a8 * b1 + a10 * b6 - a11 * b0
    m7 = a1 * b3 - a2 * b1 + a3 * b0 - a7 * b3 + a9 * b1 - a10 * b0
    m8 = a0 * b6 - a5 * b0 - a6 * b1 - a7 * b2 - a8 * b3 - a9 * b4 - a10 * b5
    m9 = a0 * b7 + a1 * b8 + a2 * b9 + a4 * b7 - a5 * b6 - a6 * b2 + a7 * b8 - a8 * b4 + a9 * b9 - a11 * b5
    m10 = a0 * b8 - a1 * b7 + a3 * b9 + a4 * b8 + a5 * b2 - a6 * b6 - a7 * b7 - a8 * b5 + a10 * b9 + a11 * b4
    m11 = a1 * b6 + a4 * b2 - a5 * b1 + a6 * b0 - a9 * b5 + a10 * b4 - a11 * b3
    m12 = a0 * b9 - a2 * b7 - a3 * b8 + a4 * b9 + a5 * b4 + a6 * b5 - a8 * b6 - a9 * b7 - a10 * b8 - a11 * b2
    m13 = a2 * b6 + a4 * b4 - a5 * b3 + a7 * b5 + a8 * b0 - a10 * b2 + a11 * b1
    m14 = a3 * b6 + a4 * b5 - a6 * b3 - a7 * b4 + a8 * b1 + a9 * b2 - a11 * b0
    m15 = a1 * b9 - a2 * b8 + a3 * b7 + a5 * b5 - a6 * b4 + a7 * b9 + a8 * b2 - a9 * b8 + a10 * b7 - a11 * b6
    r0 = m1 * a0 - m1 * a4 + m2 * a1 - m2 * a7 + m4 * a2 - m4 * a9 + m7 * a3 - m7 * a10
    r1 = -m1 * a1 + m1 * a7 + m2 * a0 - m2 * a4 + m4 * a3 - m4 * a10 - m7 * a2 + m7 * a9
    r2 = (-m0 * a1 + m1 * a6 - m2 * a5 + m3 * a0 - m4 * a11 + m5 * a3 - m6 * a2 + m7 * a8 + m8 * a7 - m11 * a4
        - m13 * a10 + m14 * a9)
    r3 = -m1 * a2 + m1 * a9 - m2 * a3 + m2 * a10 + m4 * a0 - m4 * a4 + m7 * a1 - m7 * a7
    r4 = (-m0 * a2 + m1 * a8 + m2 * a11 - m3 * a3 - m4 * a5 + m5 * a0 + m6 * a1 - m7 * a6 + m8 * a9 + m11 * a10
        - m13 * a4 - m14 * a7)
    r5 = (-m0 * a3 - m1 * a11 + m2 * a8 + m3 * a2 - m4 * a6 - m5 * a1 + m6 * a0 + m7 * a5 + m8 * a10 - m11 * a9
        + m13 * a7 - m14 * a4)
    r6 = (-m0 * a4 - m1 * a5 - m2 * a6 - m3 * a7 - m4 * a8 - m5 * a9 - m6 * a10 - m7 * a11 + m8 * a0 + m11 * a1
        + m13 * a2 + m14 * a3)
    r7 = (-m0 * a5 - m3 * a6 - m5 * a8 - m6 * a11 - m8 * a5 + m9 * a0 + m9 * a4 + m10 * a1 + m10 * a7 - m11 * a6
        + m12 * a2 + m12 * a9 - m13 * a8 - m14 * a11 + m15 * a3 + m15 * a10)
    r8 = (-m0 * a6 + m3 * a5 + m5 * a11 - m6 * a8 - m8 * a6 - m9 * a1 - m9 * a7 + m10 * a0 + m10 * a4 + m11 * a5
        + m12 * a3 + m12 * a10 + m13 * a11 - m14 * a8 - m15 * a2 - m15 * a9)
    r9 = (-m0 * a8 - m3 * a11 + m5 * a5 + m6 * a6 - m8 * a8 - m9 * a2 - m9 * a9 - m10 * a3 - m10 * a10 - m11 * a11
        + m12 * a0 + m12 * a4 + m13 * a5 + m14 * a6 + m15 * a1 + m15 * a7)
    return r0, r1, r2, r3, r4, r5, r6, r7, r8, r9


def sandwich_similarity_circle(a, b):
    """a b ~a: similarity and circle to circle (e012 e013 e023 e123 e01i e02i e12i e03i e13i e23i).

    240 mul, 214 add.
    """
    a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11 = a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], a[9], a[10], a[11]
    b0, b1, b2, b3, b4, b5, b6, b7, b8, b9 = b[0], b[1], b[2], b[3], b[4], b[5], b[6], b[7], b[8], b[9]
    m0 = -a1 * b0 - a2 * b1 - a3 * b2 + a7 * b0 + a9 * b1 + a10 * b2
    m1 = -a3 * b3 - a4 * b4 + a6 * b0 - a7 * b5 + a8 * b1 - a9 * b7 + a11 * b2
    m2 = a2 * b3 - a4 * b5 - a5 * b0 + a7 * b4 + a8 * b2 - a10 * b7 - a11 * b1
    m3 = a0 * b0 - a2 * b2 + a3 * b1 - a4 * b0 + a9 * b2 - a10 * b1
    m4 = -a1 * b3 - a4 * b7 - a5 * b1 - a6 * b2 + a9 * b4 + a10 * b5 + a11 * b0
    m5 = a0 * b1 + a1 * b2 - a3 * b0 - a4 * b1 - a7 * b2 + a10 * b0
    m6 = a0 * b2 - a1 * b1 + a2 * b0 - a4 * b2 + a7 * b1 - a9 * b0
    m7 = a0 * b3 - a5 * b2 + a6 * b1 - a7 * b7 - a8 * b0 + a9 * b5 - a10 * b4
    m8 = -a1 * b6 - a2 * b8 - a3 * b9 - a5 * b4 - a6 * b5 - a7 * b6 - a8 * b7 - a9 * b8 - a10 * b9 + a11 * b3
    m9 = a0 * b4 + a1 * b5 + a2 * b7 - a6 * b0 - a8 * b1 + a10 * b3 - a11 * b2
    m10 = a0 * b5 - a1 * b4 + a3 * b7 + a5 * b0 - a8 * b2 - a9 * b3 + a11 * b1
    m11 = a0 * b6 - a2 * b9 + a3 * b8 + a4 * b6 - a5 * b5 + a6 * b4 - a8 * b3 - a9 * b9 + a10 * b8 - a11 * b7
    m12 = a0 * b7 - a2 * b4 - a3 * b5 + a5 * b1 + a6 * b2 + a7 * b3 - a11 * b0
    m13 = a0 * b8 + a1 * b9 - a3 * b6 + a4 * b8 - a5 * b7 + a6 * b3 + a7 * b9 + a8 * b4 - a10 * b6 + a11 * b5
    m14 = a0 * b9 - a1 * b8 + a2 * b6 + a4 * b9 - a5 * b3 - a6 * b7 - a7 * b8 + a8 * b5 + a9 * b6 - a11 * b4
    m15 = a1 * b7 - a2 * b5 + a3 * b4 - a4 * b3 + a5 * b2 - a6 * b1 + a8 * b0
    r0 = -m0 * a1 + m0 * a7 + m3 * a0 - m3 * a4 + m5 * a3 - m5 * a10 - m6 * a2 + m6 * a9
    r1 = -m0 * a2 + m0 * a9 - m3 * a3 + m3 * a10 + m5 * a0 - m5 * a4 + m6 * a1 - m6 * a7
    r2 = -m0 * a3 + m0 * a10 + m3 * a2 - m3 * a9 - m5 * a1 + m5 * a7 + m6 * a0 - m6 * a4
    r3 = (m0 * a11 - m1 * a3 + m2 * a2 - m3 * a8 - m4 * a1 + m5 * a6 - m6 * a5 + m7 * a0 - m9 * a10 + m10 * a9
        - m12 * a7 + m15 * a4)
    r4 = (-m0 * a5 + m1 * a4 + m2 * a7 - m3 * a6 + m4 * a9 - m5 * a8 - m6 * a11 + m7 * a10 + m9 * a0 + m10 * a1
        + m12 * a2 + m15 * a3)
    r5 = (-m0 * a6 - m1 * a7 + m2 * a4 + m3 * a5 + m4 * a10 + m5 * a11 - m6 * a8 - m7 * a9 - m9 * a1 + m10 * a0
        + m12 * a3 - m15 * a2)
    r6 = (-m1 * a6 + m2 * a5 + m4 * a11 - m7 * a8 - m8 * a1 - m8 * a7 + m9 * a6 - m10 * a5 + m11 * a0 + m11 * a4
        - m12 * a11 + m13 * a3 + m13 * a10 - m14 * a2 - m14 * a9 + m15 * a8)
    r7 = (-m0 * a8 - m1 * a9 - m2 * a10 - m3 * a11 + m4 * a4 + m5 * a5 + m6 * a6 + m7 * a7 - m9 * a2 - m10 * a3
        + m12 * a0 + m15 * a1)
    r8 = (-m1 * a8 - m2 * a11 + m4 * a5 + m7 * a6 - m8 * a2 - m8 * a9 + m9 * a8 + m10 * a11 - m11 * a3 - m11 * a10
        - m12 * a5 + m13 * a0 + m13 * a4 + m14 * a1 + m14 * a7 - m15 * a6)
    r9 = (m1 * a11 - m2 * a8 + m4 * a6 - m7 * a5 - m8 * a3 - m8 * a10 - m9 * a11 + m10 * a8 + m11 * a2 + m11 * a9
        - m12 * a6 - m13 * a1 - m13 * a7 + m14 * a0 + m14 * a4 + m15 * a5)
    return r0, r1, r2, r3, r4, r5, r6, r7, r8, r9


def sandwich_similarity_sphere(a, b):
    """a b ~a: similarity and sphere to sphere (e0123 e012i e013i e023i e123i).

    120 mul, 99 add.
    """
    a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11 = a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], a[9], a[10], a[11]
    b0, b1, b2, b3, b4 = b[0], b[1], b[2], b[3], b[4]
    m0 = -a7 * b1 - a9 * b2 - a10 * b3 + a11 * b0
    m1 = -a3 * b0 + a10 * b0
    m2 = a2 * b0 - a9 * b0
    m3 = a4 * b1 - a8 * b0 - a9 * b3 + a10 * b2
    m4 = -a1 * b0 + a7 * b0
    m5 = a4 * b2 + a6 * b0 + a7 * b3 - a10 * b1
    m6 = a4 * b3 - a5 * b0 - a7 * b2 + a9 * b1
    m7 = a0 * b0 - a4 * b0
    m8 = -a1 * b1 - a2 * b2 - a3 * b3 + a11 * b0
    m9 = -a3 * b4 + a6 * b1 + a8 * b2 - a10 * b4 + a11 * b3
    m10 = a2 * b4 - a5 * b1 + a8 * b3 + a9 * b4 - a11 * b2
    m11 = a0 * b1 - a2 * b3 + a3 * b2 - a8 * b0
    m12 = -a1 * b4 - a5 * b2 - a6 * b3 - a7 * b4 + a11 * b1
    m13 = a0 * b2 + a1 * b3 - a3 * b1 + a6 * b0
    m14 = a0 * b3 - a1 * b2 + a2 * b1 - a5 * b0
    m15 = a0 * b4 + a4 * b4 - a5 * b3 + a6 * b2 - a8 * b1
    r0 = -m1 * a3 + m1 * a10 + m2 * a2 - m2 * a9 - m4 * a1 + m4 * a7 + m7 * a0 - m7 * a4
    r1 = (m0 * a7 - m1 * a6 + m2 * a5 - m3 * a4 + m4 * a11 - m5 * a10 + m6 * a9 - m7 * a8 - m8 * a1 + m11 * a0
        + m13 * a3 - m14 * a2)
    r2 = (m0 * a9 - m1 * a8 - m2 * a11 + m3 * a10 + m4 * a5 - m5 * a4 - m6 * a7 + m7 * a6 - m8 * a2 - m11 * a3
        + m13 * a0 + m14 * a1)
    r3 = (m0 * a10 + m1 * a11 - m2 * a8 - m3 * a9 + m4 * a6 + m5 * a7 - m6 * a4 - m7 * a5 - m8 * a3 + m11 * a2
        - m13 * a1 + m14 * a0)
    r4 = (m0 * a11 - m3 * a8 + m5 * a6 - m6 * a5 + m8 * a11 - m9 * a3 - m9 * a10 + m10 * a2 + m10 * a9 - m11 * a8
        - m12 * a1 - m12 * a7 + m13 * a6 - m14 * a5 + m15 * a0 + m15 * a4)
    return r0, r1, r2, r3, r4


def sandwich_similarity_similarity_bivector(a, b):
    """a b ~a: similarity and similarity_bivector to similarity_bivector (e12 e13 e23 e0i e1i e2i e3i).

    152 mul, 133 add.
    """
    a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11 = a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], a[9], a[10], a[11]
    b0, b1, b2, b3, b4, b5, b6 = b[0], b[1], b[2], b[3], b[4], b[5], b[6]
    m0 = -a1 * b0 - a2 * b1 - a3 * b2 + a4 * b3
    m1 = a0 * b0 - a2 * b2 + a3 * b1 + a7 * b3
    m2 = a0 * b1 + a1 * b2 - a3 * b0 + a9 * b3
    m3 = a0 * b2 - a1 * b1 + a2 * b0 + a10 * b3
    m4 = a0 * b3 - a7 * b0 - a9 * b1 - a10 * b2
    m5 = a0 * b4 + a1 * b5 + a2 * b6 + a4 * b4 - a5 * b3 - a6 * b0 + a7 * b5 - a8 * b1 + a9 * b6 - a11 * b2
    m6 = a0 * b5 - a1 * b4 + a3 * b6 + a4 * b5 + a5 * b0 - a6 * b3 - a7 * b4 - a8 * b2 + a10 * b6 + a11 * b1
    m7 = a1 * b3 + a4 * b0 - a9 * b2 + a10 * b1
    m8 = a0 * b6 - a2 * b4 - a3 * b5 + a4 * b6 + a5 * b1 + a6 * b2 - a8 * b3 - a9 * b4 - a10 * b5 - a11 * b0
    m9 = a2 * b3 + a4 * b1 + a7 * b2 - a10 * b0
    m10 = a3 * b3 + a4 * b2 - a7 * b1 + a9 * b0
    m11 = a1 * b6 - a2 * b5 + a3 * b4 + a5 * b2 - a6 * b1 + a7 * b6 + a8 * b0 - a9 * b5 + a10 * b4 - a11 * b3
    r0 = -m0 * a1 + m1 * a0 + m2 * a3 - m3 * a2 + m4 * a7 - m7 * a4 - m9 * a10 + m10 * a9
    r1 = -m0 * a2 - m1 * a3 + m2 * a0 + m3 * a1 + m4 * a9 + m7 * a10 - m9 * a4 - m10 * a7
    r2 = -m0 * a3 + m1 * a2 - m2 * a1 + m3 * a0 + m4 * a10 - m7 * a9 + m9 * a7 - m10 * a4
    r3 = -m0 * a4 - m1 * a7 - m2 * a9 - m3 * a10 + m4 * a0 + m7 * a1 + m9 * a2 + m10 * a3
    r4 = (-m0 * a5 - m1 * a6 - m2 * a8 - m3 * a11 - m4 * a5 + m5 * a0 + m5 * a4 + m6 * a1 + m6 * a7 - m7 * a6
        + m8 * a2 + m8 * a9 - m9 * a8 - m10 * a11 + m11 * a3 + m11 * a10)
    r5 = (-m0 * a6 + m1 * a5 + m2 * a11 - m3 * a8 - m4 * a6 - m5 * a1 - m5 * a7 + m6 * a0 + m6 * a4 + m7 * a5
        + m8 * a3 + m8 * a10 + m9 * a11 - m10 * a8 - m11 * a2 - m11 * a9)
    r6 = (-m0 * a8 - m1 * a11 + m2 * a5 + m3 * a6 - m4 * a8 - m5 * a2 - m5 * a9 - m6 * a3 - m6 * a10 - m7 * a11
        + m8 * a0 + m8 * a4 + m9 * a5 + m10 * a6 + m11 * a1 + m11 * a7)
    return r0, r1, r2, r3, r4, r5, r6


def triangular_triangular(a, b):
    """a b of similarities in triangular form (p | m | W): p = p1 p2, m = m1 m2, W = W1 m2 + p1 W2.

    64 mul, 52 add.
    """
    a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11 = a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], a[9], a[10], a[11]
    b0, b1, b2, b3, b4, b5, b6, b7, b8, b9, b10, b11 = b[0], b[1], b[2], b[3], b[4], b[5], b[6], b[7], b[8], b[9], b[10], b[11]
    r0 = a0 * b0 - a1 * b1 - a2 * b2 - a3 * b3
    r1 = a0 * b1 + a1 * b0 - a2 * b3 + a3 * b2
    r2 = a0 * b2 + a1 * b3 + a2 * b0 - a3 * b1
    r3 = a0 * b3 - a1 * b2 + a2 * b1 + a3 * b0
    r4 = a4 * b4 - a5 * b5 - a6 * b6 - a7 * b7
    r5 = a4 * b5 + a5 * b4 - a6 * b7 + a7 * b6
    r6 = a4 * b6 + a5 * b7 + a6 * b4 - a7 * b5
    r7 = a4 * b7 - a5 * b6 + a6 * b5 + a7 * b4
    r8 = a8 * b4 - a9 * b5 - a10 * b6 - a11 * b7 + a0 * b8 + a1 * b9 + a2 * b10 - a3 * b11
    r9 = a8 * b5 + a9 * b4 - a10 * b7 + a11 * b6 + a0 * b9 - a1 * b8 + a2 * b11 + a3 * b10
    r10 = a8 * b6 + a9 * b7 + a10 * b4 - a11 * b5 + a0 * b10 - a1 * b11 - a2 * b8 - a3 * b9
    r11 = a8 * b7 - a9 * b6 + a10 * b5 + a11 * b4 + a0 * b11 + a1 * b10 - a2 * b9 + a3 * b8
    return r0, r1, r2, r3, r4, r5, r6, r7, r8, r9, r10, r11


def similarity_to_triangular(a):
    """similarity to (p | m | W): p = A + K = s R, m = A - K = R/s, d = s^2.

    8 add.
    """
    a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11 = a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], a[9], a[10], a[11]
    r0 = a0 + a4
    r1 = a1 + a7
    r2 = a2 + a9
    r3 = a3 + a10
    r4 = a0 - a4
    r5 = a1 - a7
    r6 = a2 - a9
    r7 = a3 - a10
    return r0, r1, r2, r3, r4, r5, r6, r7, a5, a6, a8, a11


def triangular_to_similarity(a):
    """(p | m | W) to similarity: A = (p + m)/2, K = (p - m)/2.

    8 add, 8 halvings.
    """
    a0, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, a11 = a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], a[9], a[10], a[11]
    r0 = (a0 + a4) / 2
    r1 = (a1 + a5) / 2
    r2 = (a2 + a6) / 2
    r3 = (a3 + a7) / 2
    r4 = (a0 - a4) / 2
    r7 = (a1 - a5) / 2
    r9 = (a2 - a6) / 2
    r10 = (a3 - a7) / 2
    return r0, r1, r2, r3, r4, a8, a9, r7, a10, r9, r10, a11


def motor_origin_position(a):
    """position of the origin carried by a unit motor: t = -2 W ~R, W = (e1i e2i e3i e123i) and R = (1 e12 e13 e23).

    12 mul, 9 add, 3 doublings.
    """
    a0, a1, a2, a3, a4, a5, a6, a7 = a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7]
    r0 = 2 * (-a4 * a0 - a5 * a1 - a6 * a2 - a7 * a3)
    r1 = 2 * (a4 * a1 - a5 * a0 - a6 * a3 + a7 * a2)
    r2 = 2 * (a4 * a2 + a5 * a3 - a6 * a0 - a7 * a1)
    return r0, r1, r2


def motor_origin_point(a):
    """the same as a point e0 + t + t^2/2 ei, without its e0 = 1 (e1 e2 e3 ei).

    15 mul, 11 add, 3 doublings, 1 halving.
    """
    a0, a1, a2, a3, a4, a5, a6, a7 = a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7]
    r0 = 2 * (-a4 * a0 - a5 * a1 - a6 * a2 - a7 * a3)
    r1 = 2 * (a4 * a1 - a5 * a0 - a6 * a3 + a7 * a2)
    r2 = 2 * (a4 * a2 + a5 * a3 - a6 * a0 - a7 * a1)
    r3 = (r0 * r0 + r1 * r1 + r2 * r2) / 2
    return r0, r1, r2, r3
