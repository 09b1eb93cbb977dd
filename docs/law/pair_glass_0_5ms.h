/* pair_glass_0_5ms.h - contact law of one pair of bodies, C99 (and C++), SI units.
 * Glass on glass, 22.2 mm striking 15.9 mm at 0.5 m/s
 * striker 22.20 mm of glass, target 15.90 mm of glass
 *
 * Stands for: Ting's model with finite size.
 * Checked from 50.00 mm/s to 5.000 m/s, contact radius up to 0.12 of R*, 100 steps per contact: e within 2.1e-4,
 * contact time within 0.5 % and largest force within 0.16 % of that model. Take 50 steps or more.
 *
 *    speed, m/s         e   +/- law   +/- model   contact time, s
 *    5.00000e-2  0.88738   0.00009      0.0001     9.90847e-5
 *    8.89140e-2  0.89899   0.00010      0.0001     8.83213e-5
 *    1.58114e-1  0.90949   0.00010      0.0002     7.87038e-5
 *    2.81171e-1  0.91897   0.00005      0.0002     7.01084e-5
 *    5.00000e-1  0.92752   0.00011      0.0002     6.24242e-5
 *    8.89140e-1  0.93524   0.00012      0.0003     5.55518e-5
 *     1.58114e0  0.94220   0.00014      0.0003     4.94017e-5
 *     2.81171e0  0.94847   0.00017      0.0004     4.38938e-5
 *     5.00000e0  0.95413   0.00020      0.0006     3.89556e-5
 *
 * Made by fem-run 0.1.0: fem-run export CASE --law. Licence: MIT or Apache-2.0.
 *
 *   pair_glass_0_5ms_state contact;                               one per contact, 1024 bytes in double
 *   pair_glass_0_5ms_begin(&contact);                             first touch of two bodies
 *   force = pair_glass_0_5ms_force(&contact, approach, approach_speed, step);     once in every step
 *   pair_glass_0_5ms_end(&contact);                               the bodies have parted
 *
 * The approach is the overlap of the undeformed bodies at the end of the step, m, its speed is positive in closing, and a
 * positive force parts the bodies. Call it from first touch until the overlap is below -pair_glass_0_5ms_reach. A contact may be
 * pressed again, held or let go at any time. Steps of any length are stable in the contact; the motion needs those named above.
 * #define PAIR_REAL float before the first header of this kind for single precision.
 */
#ifndef PAIR_GLASS_0_5MS_H
#define PAIR_GLASS_0_5MS_H

#include <math.h>

#ifndef PAIR_REAL
#define PAIR_REAL double
#endif

/* Effective radius, m, effective mass, kg, and contact modulus before relaxation, Pa. */
static const double pair_glass_0_5ms_radius = 4.632283465e-3;
static const double pair_glass_0_5ms_mass = 3.678697875e-3;
static const double pair_glass_0_5ms_modulus = 3.349410504e10;
/* Distance of the surfaces up to which the contact may still hold, m. */
static const double pair_glass_0_5ms_reach = 0.000000000e0;
/* Speeds between which the law was checked, m/s. */
static const double pair_glass_0_5ms_speeds[2] = {5.000000000e-2, 5.000000000e0};

enum {
    pair_glass_0_5ms_springs = 42, /* on the line x, from the middle outward */
    pair_glass_0_5ms_terms = 1, /* of the relaxation, beside the part that stays */
    pair_glass_0_5ms_iterations = 30
};

/* Approach at which each spring is reached, m, and its stiffness before relaxation, N/m. */
static const PAIR_REAL pair_glass_0_5ms_gap[pair_glass_0_5ms_springs] = {
    3.001406941e-9, 2.698387846e-8, 7.486250273e-8, 1.465348754e-7, 2.418918350e-7, 3.608197558e-7,
    5.032017494e-7, 6.689184155e-7, 8.578483597e-7, 1.069868572e-6, 1.304854719e-6, 1.562681372e-6,
    1.843222195e-6, 2.159468718e-6, 2.529558890e-6, 2.962543732e-6, 3.468963352e-6, 4.061082965e-6,
    4.753163847e-6, 5.561773712e-6, 6.506141368e-6, 7.608560883e-6, 8.894850777e-6, 1.039487397e-5,
    1.214312433e-5, 1.417938556e-5, 1.654946778e-5, 1.930602671e-5, 2.250946892e-5, 2.622894544e-5,
    3.054343352e-5, 3.554290333e-5, 4.132956249e-5, 4.801916616e-5, 5.574237426e-5, 6.464612944e-5,
    7.489502051e-5, 8.667258528e-5, 1.150149202e-4, 1.703518306e-4, 2.490570941e-4, 3.585144314e-4};
static const PAIR_REAL pair_glass_0_5ms_stiffness[pair_glass_0_5ms_springs] = {
    4.996452750e5, 4.996452750e5, 4.996452750e5, 4.996452750e5, 4.996452750e5, 4.996452750e5,
    4.996452750e5, 4.996452750e5, 4.996452750e5, 4.996452750e5, 4.996452750e5, 4.996452750e5,
    4.996452750e5, 5.412823813e5, 5.863892464e5, 6.352550169e5, 6.881929350e5, 7.455423463e5,
    8.076708751e5, 8.749767814e5, 9.478915132e5, 1.026882473e6, 1.112456012e6, 1.205160680e6,
    1.305590736e6, 1.414389964e6, 1.532255795e6, 1.659943778e6, 1.798272426e6, 1.948128461e6,
    2.110472500e6, 2.286345208e6, 2.476873975e6, 2.683280140e6, 2.906886818e6, 3.149127386e6,
    3.411554669e6, 3.695850891e6, 1.201151540e7, 1.501439424e7, 1.876799281e7, 2.345999101e7};
/* Shares of the stiffness: one that stays and those that relax at a rate, 1/s. */
static const PAIR_REAL pair_glass_0_5ms_equilibrium = (PAIR_REAL)0.000000000e0;
static const PAIR_REAL pair_glass_0_5ms_weight[pair_glass_0_5ms_terms] = {1.000000000e0};
static const PAIR_REAL pair_glass_0_5ms_rate[pair_glass_0_5ms_terms] = {2.708000000e3};
/* What a branch keeps at least, m: processors are slow with the smallest numbers, to which a contact at rest would relax. */
static const PAIR_REAL pair_glass_0_5ms_least = (PAIR_REAL)1e-30;

/* All members are PAIR_REAL, so that a code can keep a contact as numbers; zeros are a contact that has not begun. */
typedef struct {
    PAIR_REAL force; /* of the springs in the last step, N */
    PAIR_REAL reached; /* number of springs that have been pressed */
    PAIR_REAL compression[pair_glass_0_5ms_springs];
    PAIR_REAL load[pair_glass_0_5ms_springs]; /* over the stiffness, m */
    PAIR_REAL branch[pair_glass_0_5ms_terms][pair_glass_0_5ms_springs];
} pair_glass_0_5ms_state;

/* Ends a contact. The next one may begin at once. */
static inline void pair_glass_0_5ms_end(pair_glass_0_5ms_state *s)
{
    int i;
    s->force = 0;
    s->reached = 0;
    for (i = 0; i < pair_glass_0_5ms_springs; i++) {
        int k;
        for (k = 0; k < pair_glass_0_5ms_terms; k++) s->branch[k][i] = 0;
        s->compression[i] = s->load[i] = 0;
    }
}

/* Begins the first contact of two bodies, or one at a new spot. */
static inline void pair_glass_0_5ms_begin(pair_glass_0_5ms_state *s)
{
    pair_glass_0_5ms_end(s);
}

/* What a branch keeps over a step at a rate, by the trapezoidal rule, limited where the step is too long for it. */
static inline PAIR_REAL pair_glass_0_5ms_kept(PAIR_REAL rate, PAIR_REAL step)
{
    PAIR_REAL half = rate * step / 2;
    return half < 3 ? (1 - half) / (1 + half) : (PAIR_REAL)-0.5;
}

/* Sum of the springs at an approach, N, with what each holds if it keeps its compression. Springs only push. */
static inline PAIR_REAL pair_glass_0_5ms_sum(pair_glass_0_5ms_state *s, const PAIR_REAL *held, PAIR_REAL stiffness,
                                        PAIR_REAL approach, PAIR_REAL *slope)
{
    PAIR_REAL force = 0, rise = 0;
    int i, n = (int)s->reached;
    for (i = 0; i < n; i++) {
        PAIR_REAL load = held[i] + stiffness * (approach - pair_glass_0_5ms_gap[i] - s->compression[i]);
        load = load > 0 ? load : 0;
        s->load[i] = load;
        force += pair_glass_0_5ms_stiffness[i] * load;
    }
    *slope = rise * stiffness;
    return force;
}

/* Advances the springs by a step and returns their force, N, and their stiffness, N/m. */
static inline PAIR_REAL pair_glass_0_5ms_repulsion(pair_glass_0_5ms_state *s, PAIR_REAL approach, PAIR_REAL step,
                                              PAIR_REAL *slope)
{
    PAIR_REAL held[pair_glass_0_5ms_springs];
    PAIR_REAL stiffness = pair_glass_0_5ms_equilibrium, force;
    PAIR_REAL kept[pair_glass_0_5ms_terms];
    int k;
    int i, n = (int)s->reached;
    while (n < pair_glass_0_5ms_springs && pair_glass_0_5ms_gap[n] < approach) n++;
    s->reached = (PAIR_REAL)n;
    for (i = 0; i < n; i++) held[i] = pair_glass_0_5ms_equilibrium * s->compression[i];
    for (k = 0; k < pair_glass_0_5ms_terms; k++) {
        PAIR_REAL share;
        kept[k] = pair_glass_0_5ms_kept(pair_glass_0_5ms_rate[k], step);
        share = pair_glass_0_5ms_weight[k] * kept[k];
        stiffness += pair_glass_0_5ms_weight[k] * (1 + kept[k]) / 2;
        for (i = 0; i < n; i++) held[i] += share * s->branch[k][i];
    }
    force = pair_glass_0_5ms_sum(s, held, stiffness, approach, slope);
    /* A spring without load recovers freely. */
    stiffness = 1 / stiffness;
    for (i = 0; i < n; i++) {
        held[i] = (s->load[i] - held[i]) * stiffness;
        s->compression[i] += held[i];
    }
    for (k = 0; k < pair_glass_0_5ms_terms; k++) {
        PAIR_REAL gain = (1 + kept[k]) / 2;
        for (i = 0; i < n; i++)
            s->branch[k][i] = kept[k] * s->branch[k][i] + gain * held[i] + pair_glass_0_5ms_least;
    }
    return force;
}

/* Returns the force that parts the bodies, N, at the end of a step, s, with an approach, m, and its speed, m/s. */
static inline PAIR_REAL pair_glass_0_5ms_force(pair_glass_0_5ms_state *s, PAIR_REAL approach, PAIR_REAL approach_speed,
                                          PAIR_REAL step)
{
    PAIR_REAL force, slope;
    if (approach != approach) return approach;
    force = s->force = pair_glass_0_5ms_repulsion(s, approach, step, &slope);
    (void)approach_speed;
    return force;
}

enum { pair_glass_0_5ms_points = 17 };

/* Restitution, and contact time in s (infinite where the bodies stay together), at speeds in equal ratios. */
static const double pair_glass_0_5ms_e[pair_glass_0_5ms_points] = {
    8.873812756e-1, 8.933300235e-1, 8.989886462e-1, 9.043695898e-1, 9.094850048e-1, 9.143467303e-1,
    9.189662806e-1, 9.233548355e-1, 9.275232344e-1, 9.314819728e-1, 9.352412015e-1, 9.388107278e-1,
    9.422000200e-1, 9.454182122e-1, 9.484741125e-1, 9.513762118e-1, 9.541326955e-1};
static const double pair_glass_0_5ms_T[pair_glass_0_5ms_points] = {
    9.908465821e-5, 9.355149851e-5, 8.832133612e-5, 8.337740055e-5, 7.870381837e-5, 7.428556300e-5,
    7.010840718e-5, 6.615887820e-5, 6.242421543e-5, 5.889232999e-5, 5.555176648e-5, 5.239166647e-5,
    4.940173364e-5, 4.657220035e-5, 4.389379544e-5, 4.135771311e-5, 3.895558263e-5};

static inline double pair_glass_0_5ms_of_v(const double *values, double speed)
{
    const double *ends = pair_glass_0_5ms_speeds;
    double at = speed > ends[0] ? log(speed / ends[0]) / log(ends[1] / ends[0]) * (pair_glass_0_5ms_points - 1) : 0;
    int i = at < pair_glass_0_5ms_points - 2 ? (int)at : pair_glass_0_5ms_points - 2;
    double share = at - i;
    if (!(share > 0)) return values[i];
    if (share >= 1) return values[i + 1];
    return values[i] + share * (values[i + 1] - values[i]);
}

/* Returns the restitution at a speed of approach, m/s, for codes without contact forces; constant outside of the range. */
static inline double pair_glass_0_5ms_e_of_v(double speed)
{
    return pair_glass_0_5ms_of_v(pair_glass_0_5ms_e, speed);
}

/* Returns the contact time, s, at a speed of approach, m/s. */
static inline double pair_glass_0_5ms_T_of_v(double speed)
{
    return pair_glass_0_5ms_of_v(pair_glass_0_5ms_T, speed);
}

#endif
