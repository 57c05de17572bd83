/*
 * Laws of incompressible, isotropic rubber as functions of a = L1^2 + L2^2 and D = (L1 L2)^2, over the shear
 * modulus mu at small strain. With I1 = a + 1/D and I2 = D + a/D:
 *     neo-Hookean, Mooney-Rivlin   W = (c1 (I1 - 3) + c2 (I2 - 3))/2, c1 + c2 = 1   Mooney, J. Appl. Phys. 11, 1940
 *     Gent                         W = -J/2 ln(1 - (I1 - 3)/J)                      Gent, Rubber Chem. Technol. 69, 1996
 *     Ogden                        W = sum m_p/alpha_p (L1^alpha_p + L2^alpha_p + L3^alpha_p - 3), sum m_p alpha_p = 2
 *                                                                                   Ogden, Proc. R. Soc. A 326, 1972
 */
#ifndef SIM_MEMBRANE_LAW_H
#define SIM_MEMBRANE_LAW_H

/* A triangle that is crushed to under a quarter of its area at rest, D = (1/4)^2, must not throw its corners
 * out of the world: below it the laws are asked at D0 (1 + (D/D0)^2)/2 in place of D, so that forces end with
 * D. Below half of it nothing gets any stiffer. */
#define MEMBRANE_CRUSHED (1. / 16)

enum { MEMBRANE_TERMS_MAX = 6, MEMBRANE_SERIES = 9 };

/* Up to this alpha, or minus this, whole ones are multiplied out: rounding grows with its square. */
#define MEMBRANE_WHOLE_MOST 8.

/* The order of scene_law_names. */
enum membrane_kind { MEMBRANE_NEO_HOOKEAN, MEMBRANE_MOONEY_RIVLIN, MEMBRANE_GENT, MEMBRANE_OGDEN };

struct membrane_law {
    enum membrane_kind kind;
    double c1, c2;      /* of the first two laws */
    double limit;       /* Gent's J */
    double compression; /* the share of W that is kept where the skin wrinkles: 1, it does not wrinkle */
    int terms;          /* Ogden's */
    int whole;          /* of them, the first ones, whose alphas are small whole numbers */
    double power[MEMBRANE_TERMS_MAX], weight[MEMBRANE_TERMS_MAX]; /* alpha_p; m_p / alpha_p */
    /* Of Chebyshev's function of degree alpha_p/2 around 1 (membrane_response.h). */
    double series[MEMBRANE_TERMS_MAX][MEMBRANE_SERIES];
};

#endif
