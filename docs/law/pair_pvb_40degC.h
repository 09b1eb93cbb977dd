/* pair_pvb_40degC.h - contact law of one pair of bodies, C99 (and C++), SI units.
 * Ball of polyvinyl butyral, 10 mm, on a hard floor at 40 °C and 0.3 m/s
 * floor, rigid, ball 10.00 mm of lib:pvb
 *
 * Stands for: Ting's model with finite size.
 * Checked from 30.00 mm/s to 533.9 mm/s, contact radius up to 0.097 of R*, 100 steps per contact: e within 0.0037,
 * contact time within 0.5 % and largest force within 0.36 % of that model. Take 50 steps or more.
 *
 *    speed, m/s         e   +/- law   +/- model   contact time, s
 *    3.00000e-2  0.40275   0.00030      0.0026     5.14145e-4
 *    4.29949e-2  0.40410   0.00005      0.0031     4.72327e-4
 *    6.16188e-2  0.40498   0.00038      0.0036     4.33428e-4
 *    8.83098e-2  0.40552   0.00073      0.0043     3.97196e-4
 *    1.26562e-1  0.40588   0.00111      0.0052     3.63417e-4
 *    1.81385e-1  0.40624   0.00174      0.0062     3.31911e-4
 *    2.59954e-1  0.40681   0.00238      0.0075     3.02535e-4
 *    3.72557e-1  0.40783   0.00304      0.0090     2.75177e-4
 *    5.33936e-1  0.40955   0.00370      0.0110     2.49763e-4
 *
 * Made by fem-run 0.1.0: fem-run export CASE --law. Licence: MIT or Apache-2.0.
 *
 *   pair_pvb_40degC_state contact;                               one per contact, 2064 bytes in double
 *   pair_pvb_40degC_begin(&contact);                             first touch of two bodies
 *   force = pair_pvb_40degC_force(&contact, approach, approach_speed, step);     once in every step
 *   pair_pvb_40degC_end(&contact);                               the bodies have parted
 *
 * The approach is the overlap of the undeformed bodies at the end of the step, m, its speed is positive in closing, and a
 * positive force parts the bodies. Call it from first touch until the overlap is below -pair_pvb_40degC_reach. A contact may be
 * pressed again, held or let go at any time. Steps of any length are stable in the contact; the motion needs those named above.
 * #define PAIR_REAL float before the first header of this kind for single precision.
 */
#ifndef PAIR_PVB_40DEGC_H
#define PAIR_PVB_40DEGC_H

#include <math.h>

#ifndef PAIR_REAL
#define PAIR_REAL double
#endif

/* Effective radius, m, effective mass, kg, and contact modulus before relaxation, Pa. */
static const double pair_pvb_40degC_radius = 5.000000000e-3;
static const double pair_pvb_40degC_mass = 5.602506899e-4;
static const double pair_pvb_40degC_modulus = 1.546342466e9;
/* Distance of the surfaces up to which the contact may still hold, m. */
static const double pair_pvb_40degC_reach = 0.000000000e0;
/* Speeds between which the law was checked, m/s. */
static const double pair_pvb_40degC_speeds[2] = {3.000000000e-2, 5.339355469e-1};

enum {
    pair_pvb_40degC_springs = 32, /* on the line x, from the middle outward */
    pair_pvb_40degC_terms = 6, /* of the relaxation, beside the part that stays */
    pair_pvb_40degC_iterations = 30
};

/* Approach at which each spring is reached, m, and its stiffness before relaxation, N/m. */
static const PAIR_REAL pair_pvb_40degC_gap[pair_pvb_40degC_springs] = {
    8.900733063e-9, 7.962232458e-8, 2.198392357e-7, 4.282925009e-7, 7.037443878e-7, 1.044978033e-6,
    1.450797075e-6, 1.920025296e-6, 2.451506261e-6, 3.044102970e-6, 3.696697513e-6, 4.408190730e-6,
    5.177501884e-6, 6.039203939e-6, 7.040841078e-6, 8.204236631e-6, 9.554386364e-6, 1.111986095e-5,
    1.293324456e-5, 1.503160874e-5, 1.745701957e-5, 2.025707408e-5, 2.348545987e-5, 2.720252941e-5,
    3.147587676e-5, 3.638090145e-5, 4.200133934e-5, 4.842973615e-5, 6.378468222e-5, 9.338888868e-5,
    1.348485346e-4, 1.915781405e-4};
static const PAIR_REAL pair_pvb_40degC_stiffness[pair_pvb_40degC_springs] = {
    4.132596794e4, 4.132596794e4, 4.132596794e4, 4.132596794e4, 4.132596794e4, 4.132596794e4,
    4.132596794e4, 4.132596794e4, 4.132596794e4, 4.132596794e4, 4.132596794e4, 4.132596794e4,
    4.132596794e4, 4.476979860e4, 4.850061515e4, 5.254233308e4, 5.692086083e4, 6.166426590e4,
    6.680295473e4, 7.236986762e4, 7.840068992e4, 8.493408075e4, 9.201192081e4, 9.967958088e4,
    1.079862126e5, 1.169850637e5, 1.267338190e5, 1.372949706e5, 4.462086543e5, 5.577608179e5,
    6.972010224e5, 8.715012780e5};
/* Shares of the stiffness: one that stays and those that relax at a rate, 1/s. */
static const PAIR_REAL pair_pvb_40degC_equilibrium = (PAIR_REAL)4.616354045e-3;
static const PAIR_REAL pair_pvb_40degC_weight[pair_pvb_40degC_terms] = {6.977286335e-3, 3.300064069e-3, 3.358823285e-2, 1.001789897e-1, 9.231557235e-4, 7.752446830e-2};
static const PAIR_REAL pair_pvb_40degC_rate[pair_pvb_40degC_terms] = {2.036774883e2, 1.084228780e3, 2.501553993e3, 3.072392749e4, 7.088685058e4, 3.773493288e5};
/* What a branch keeps at least, m: processors are slow with the smallest numbers, to which a contact at rest would relax. */
static const PAIR_REAL pair_pvb_40degC_least = (PAIR_REAL)1e-30;

/* All members are PAIR_REAL, so that a code can keep a contact as numbers; zeros are a contact that has not begun. */
typedef struct {
    PAIR_REAL force; /* of the springs in the last step, N */
    PAIR_REAL reached; /* number of springs that have been pressed */
    PAIR_REAL compression[pair_pvb_40degC_springs];
    PAIR_REAL load[pair_pvb_40degC_springs]; /* over the stiffness, m */
    PAIR_REAL branch[pair_pvb_40degC_terms][pair_pvb_40degC_springs];
} pair_pvb_40degC_state;

/* Ends a contact. The next one may begin at once. */
static inline void pair_pvb_40degC_end(pair_pvb_40degC_state *s)
{
    int i;
    s->force = 0;
    s->reached = 0;
    for (i = 0; i < pair_pvb_40degC_springs; i++) {
        int k;
        for (k = 0; k < pair_pvb_40degC_terms; k++) s->branch[k][i] = 0;
        s->compression[i] = s->load[i] = 0;
    }
}

/* Begins the first contact of two bodies, or one at a new spot. */
static inline void pair_pvb_40degC_begin(pair_pvb_40degC_state *s)
{
    pair_pvb_40degC_end(s);
}

/* What a branch keeps over a step at a rate, by the trapezoidal rule, limited where the step is too long for it. */
static inline PAIR_REAL pair_pvb_40degC_kept(PAIR_REAL rate, PAIR_REAL step)
{
    PAIR_REAL half = rate * step / 2;
    return half < 3 ? (1 - half) / (1 + half) : (PAIR_REAL)-0.5;
}

/* Sum of the springs at an approach, N, with what each holds if it keeps its compression. Springs only push. */
static inline PAIR_REAL pair_pvb_40degC_sum(pair_pvb_40degC_state *s, const PAIR_REAL *held, PAIR_REAL stiffness,
                                        PAIR_REAL approach, PAIR_REAL *slope)
{
    PAIR_REAL force = 0, rise = 0;
    int i, n = (int)s->reached;
    for (i = 0; i < n; i++) {
        PAIR_REAL load = held[i] + stiffness * (approach - pair_pvb_40degC_gap[i] - s->compression[i]);
        load = load > 0 ? load : 0;
        s->load[i] = load;
        force += pair_pvb_40degC_stiffness[i] * load;
    }
    *slope = rise * stiffness;
    return force;
}

/* Advances the springs by a step and returns their force, N, and their stiffness, N/m. */
static inline PAIR_REAL pair_pvb_40degC_repulsion(pair_pvb_40degC_state *s, PAIR_REAL approach, PAIR_REAL step,
                                              PAIR_REAL *slope)
{
    PAIR_REAL held[pair_pvb_40degC_springs];
    PAIR_REAL stiffness = pair_pvb_40degC_equilibrium, force;
    PAIR_REAL kept[pair_pvb_40degC_terms];
    int k;
    int i, n = (int)s->reached;
    while (n < pair_pvb_40degC_springs && pair_pvb_40degC_gap[n] < approach) n++;
    s->reached = (PAIR_REAL)n;
    for (i = 0; i < n; i++) held[i] = pair_pvb_40degC_equilibrium * s->compression[i];
    for (k = 0; k < pair_pvb_40degC_terms; k++) {
        PAIR_REAL share;
        kept[k] = pair_pvb_40degC_kept(pair_pvb_40degC_rate[k], step);
        share = pair_pvb_40degC_weight[k] * kept[k];
        stiffness += pair_pvb_40degC_weight[k] * (1 + kept[k]) / 2;
        for (i = 0; i < n; i++) held[i] += share * s->branch[k][i];
    }
    force = pair_pvb_40degC_sum(s, held, stiffness, approach, slope);
    /* A spring without load recovers freely. */
    stiffness = 1 / stiffness;
    for (i = 0; i < n; i++) {
        held[i] = (s->load[i] - held[i]) * stiffness;
        s->compression[i] += held[i];
    }
    for (k = 0; k < pair_pvb_40degC_terms; k++) {
        PAIR_REAL gain = (1 + kept[k]) / 2;
        for (i = 0; i < n; i++)
            s->branch[k][i] = kept[k] * s->branch[k][i] + gain * held[i] + pair_pvb_40degC_least;
    }
    return force;
}

/* Returns the force that parts the bodies, N, at the end of a step, s, with an approach, m, and its speed, m/s. */
static inline PAIR_REAL pair_pvb_40degC_force(pair_pvb_40degC_state *s, PAIR_REAL approach, PAIR_REAL approach_speed,
                                          PAIR_REAL step)
{
    PAIR_REAL force, slope;
    if (approach != approach) return approach;
    force = s->force = pair_pvb_40degC_repulsion(s, approach, step, &slope);
    (void)approach_speed;
    return force;
}

enum { pair_pvb_40degC_points = 17 };

/* Restitution, and contact time in s (infinite where the bodies stay together), at speeds in equal ratios. */
static const double pair_pvb_40degC_e[pair_pvb_40degC_points] = {
    4.027537288e-1, 4.034887100e-1, 4.040953263e-1, 4.045862621e-1, 4.049760207e-1, 4.052809677e-1,
    4.055193647e-1, 4.057113871e-1, 4.058791194e-1, 4.060465174e-1, 4.062393283e-1, 4.064849582e-1,
    4.068122743e-1, 4.072513347e-1, 4.078330368e-1, 4.085886862e-1, 4.095494884e-1};
static const double pair_pvb_40degC_T[pair_pvb_40degC_points] = {
    5.141449652e-4, 4.928542722e-4, 4.723272381e-4, 4.525291402e-4, 4.334275886e-4, 4.149924469e-4,
    3.971957820e-4, 3.800118381e-4, 3.634170337e-4, 3.473899750e-4, 3.319114773e-4, 3.169645839e-4,
    3.025345652e-4, 2.886088814e-4, 2.751770853e-4, 2.622306468e-4, 2.497626799e-4};

static inline double pair_pvb_40degC_of_v(const double *values, double speed)
{
    const double *ends = pair_pvb_40degC_speeds;
    double at = speed > ends[0] ? log(speed / ends[0]) / log(ends[1] / ends[0]) * (pair_pvb_40degC_points - 1) : 0;
    int i = at < pair_pvb_40degC_points - 2 ? (int)at : pair_pvb_40degC_points - 2;
    double share = at - i;
    if (!(share > 0)) return values[i];
    if (share >= 1) return values[i + 1];
    return values[i] + share * (values[i + 1] - values[i]);
}

/* Returns the restitution at a speed of approach, m/s, for codes without contact forces; constant outside of the range. */
static inline double pair_pvb_40degC_e_of_v(double speed)
{
    return pair_pvb_40degC_of_v(pair_pvb_40degC_e, speed);
}

/* Returns the contact time, s, at a speed of approach, m/s. */
static inline double pair_pvb_40degC_T_of_v(double speed)
{
    return pair_pvb_40degC_of_v(pair_pvb_40degC_T, speed);
}

#endif
