/* pair_rubber.h - contact law of one pair of bodies, C99 (and C++), SI units.
 * Ball of rubber, EPDM, 10 mm, on a hard floor at 0.3 m/s
 * floor, rigid, ball 10.00 mm of lib:epdm
 *
 * Stands for: Ting's model.
 * Checked from 30.00 mm/s to 3.000 m/s, contact radius up to 0.26 of R*, 100 steps per contact: e within 0.0038,
 * contact time within 0.5 % and largest force within 0.32 % of that model. Take 50 steps or more.
 *
 *    speed, m/s         e   +/- law   +/- model   contact time, s
 *    3.00000e-2  0.86553   0.00141      0.0013     8.69825e-4
 *    5.33484e-2  0.86413   0.00199      0.0018     7.72494e-4
 *    9.48683e-2  0.86267   0.00254      0.0025     6.86063e-4
 *    1.68702e-1  0.86109   0.00304      0.0034     6.09312e-4
 *    3.00000e-1  0.85938   0.00342      0.0086     5.41150e-4
 *    5.33484e-1  0.85750   0.00368      0.0116     4.80608e-4
 *    9.48683e-1  0.85542   0.00376      0.0161     4.26825e-4
 *     1.68702e0  0.85314   0.00370      0.0231     3.79041e-4
 *     3.00000e0  0.85066   0.00346      0.0348     3.36580e-4
 *
 * Made by fem-run 0.1.0: fem-run export CASE --law. Licence: MIT or Apache-2.0.
 *
 *   pair_rubber_state contact;                               one per contact, 1984 bytes in double
 *   pair_rubber_begin(&contact);                             first touch of two bodies
 *   force = pair_rubber_force(&contact, approach, approach_speed, step);     once in every step
 *   pair_rubber_end(&contact);                               the bodies have parted
 *
 * The approach is the overlap of the undeformed bodies at the end of the step, m, its speed is positive in closing, and a
 * positive force parts the bodies. Call it from first touch until the overlap is below -pair_rubber_reach. A contact may be
 * pressed again, held or let go at any time. Steps of any length are stable in the contact; the motion needs those named above.
 * #define PAIR_REAL float before the first header of this kind for single precision.
 */
#ifndef PAIR_RUBBER_H
#define PAIR_RUBBER_H

#include <math.h>

#ifndef PAIR_REAL
#define PAIR_REAL double
#endif

/* Effective radius, m, effective mass, kg, and contact modulus before relaxation, Pa. */
static const double pair_rubber_radius = 5.000000000e-3;
static const double pair_rubber_mass = 5.235987756e-4;
static const double pair_rubber_modulus = 1.678326996e8;
/* Distance of the surfaces up to which the contact may still hold, m. */
static const double pair_rubber_reach = 0.000000000e0;
/* Speeds between which the law was checked, m/s. */
static const double pair_rubber_speeds[2] = {3.000000000e-2, 3.000000000e0};

enum {
    pair_rubber_springs = 41, /* on the line x, from the middle outward */
    pair_rubber_terms = 4, /* of the relaxation, beside the part that stays */
    pair_rubber_iterations = 30
};

/* Approach at which each spring is reached, m, and its stiffness before relaxation, N/m. */
static const PAIR_REAL pair_rubber_gap[pair_rubber_springs] = {
    1.524212896e-8, 1.371791606e-7, 3.810532240e-7, 7.468643190e-7, 1.234612446e-6, 1.844297604e-6,
    2.575919794e-6, 3.429479016e-6, 4.404975269e-6, 5.502408554e-6, 6.721778871e-6, 8.063086220e-6,
    9.526330600e-6, 1.118020744e-5, 1.312121568e-5, 1.539920451e-5, 1.807267751e-5, 2.121029514e-5,
    2.489263804e-5, 2.921427659e-5, 3.428619961e-5, 4.023866482e-5, 4.722454413e-5, 5.542324971e-5,
    6.504534167e-5, 7.633793571e-5, 8.959104955e-5, 1.051450512e-4, 1.233994004e-4, 1.448229074e-4,
    1.699657733e-4, 1.994737200e-4, 2.341045742e-4, 2.747477294e-4, 3.224469880e-4, 3.784273678e-4,
    4.441265637e-4, 6.079648530e-4, 9.499450828e-4, 1.484289192e-3, 2.319201862e-3};
static const PAIR_REAL pair_rubber_stiffness[pair_rubber_springs] = {
    5.860631158e3, 5.860631158e3, 5.860631158e3, 5.860631158e3, 5.860631158e3, 5.860631158e3,
    5.860631158e3, 5.860631158e3, 5.860631158e3, 5.860631158e3, 5.860631158e3, 5.860631158e3,
    5.860631158e3, 6.349017088e3, 6.878101846e3, 7.451276999e3, 8.072216749e3, 8.744901478e3,
    9.473643268e3, 1.026311354e4, 1.111837300e4, 1.204490409e4, 1.304864609e4, 1.413603327e4,
    1.531403604e4, 1.659020571e4, 1.797272285e4, 1.947044976e4, 2.109298724e4, 2.285073617e4,
    2.475496419e4, 2.681787787e4, 2.905270103e4, 3.147375944e4, 3.409657273e4, 3.693795379e4,
    4.001611661e4, 1.300523790e5, 1.625654737e5, 2.032068421e5, 2.540085527e5};
/* Shares of the stiffness: one that stays and those that relax at a rate, 1/s. */
static const PAIR_REAL pair_rubber_equilibrium = (PAIR_REAL)1.193495527e-1;
static const PAIR_REAL pair_rubber_weight[pair_rubber_terms] = {2.149667160e-2, 2.187600972e-2, 2.781682364e-2, 1.103714167e-1};
static const PAIR_REAL pair_rubber_rate[pair_rubber_terms] = {4.013057955e2, 3.559408975e3, 3.157041935e4, 2.800159760e5};
/* What a branch keeps at least, m: processors are slow with the smallest numbers, to which a contact at rest would relax. */
static const PAIR_REAL pair_rubber_least = (PAIR_REAL)1e-30;

/* All members are PAIR_REAL, so that a code can keep a contact as numbers; zeros are a contact that has not begun. */
typedef struct {
    PAIR_REAL force; /* of the springs in the last step, N */
    PAIR_REAL reached; /* number of springs that have been pressed */
    PAIR_REAL compression[pair_rubber_springs];
    PAIR_REAL load[pair_rubber_springs]; /* over the stiffness, m */
    PAIR_REAL branch[pair_rubber_terms][pair_rubber_springs];
} pair_rubber_state;

/* Ends a contact. The next one may begin at once. */
static inline void pair_rubber_end(pair_rubber_state *s)
{
    int i;
    s->force = 0;
    s->reached = 0;
    for (i = 0; i < pair_rubber_springs; i++) {
        int k;
        for (k = 0; k < pair_rubber_terms; k++) s->branch[k][i] = 0;
        s->compression[i] = s->load[i] = 0;
    }
}

/* Begins the first contact of two bodies, or one at a new spot. */
static inline void pair_rubber_begin(pair_rubber_state *s)
{
    pair_rubber_end(s);
}

/* What a branch keeps over a step at a rate, by the trapezoidal rule, limited where the step is too long for it. */
static inline PAIR_REAL pair_rubber_kept(PAIR_REAL rate, PAIR_REAL step)
{
    PAIR_REAL half = rate * step / 2;
    return half < 3 ? (1 - half) / (1 + half) : (PAIR_REAL)-0.5;
}

/* Sum of the springs at an approach, N, with what each holds if it keeps its compression. Springs only push. */
static inline PAIR_REAL pair_rubber_sum(pair_rubber_state *s, const PAIR_REAL *held, PAIR_REAL stiffness,
                                        PAIR_REAL approach, PAIR_REAL *slope)
{
    PAIR_REAL force = 0, rise = 0;
    int i, n = (int)s->reached;
    for (i = 0; i < n; i++) {
        PAIR_REAL load = held[i] + stiffness * (approach - pair_rubber_gap[i] - s->compression[i]);
        load = load > 0 ? load : 0;
        s->load[i] = load;
        force += pair_rubber_stiffness[i] * load;
    }
    *slope = rise * stiffness;
    return force;
}

/* Advances the springs by a step and returns their force, N, and their stiffness, N/m. */
static inline PAIR_REAL pair_rubber_repulsion(pair_rubber_state *s, PAIR_REAL approach, PAIR_REAL step,
                                              PAIR_REAL *slope)
{
    PAIR_REAL held[pair_rubber_springs];
    PAIR_REAL stiffness = pair_rubber_equilibrium, force;
    PAIR_REAL kept[pair_rubber_terms];
    int k;
    int i, n = (int)s->reached;
    while (n < pair_rubber_springs && pair_rubber_gap[n] < approach) n++;
    s->reached = (PAIR_REAL)n;
    for (i = 0; i < n; i++) held[i] = pair_rubber_equilibrium * s->compression[i];
    for (k = 0; k < pair_rubber_terms; k++) {
        PAIR_REAL share;
        kept[k] = pair_rubber_kept(pair_rubber_rate[k], step);
        share = pair_rubber_weight[k] * kept[k];
        stiffness += pair_rubber_weight[k] * (1 + kept[k]) / 2;
        for (i = 0; i < n; i++) held[i] += share * s->branch[k][i];
    }
    force = pair_rubber_sum(s, held, stiffness, approach, slope);
    /* A spring without load recovers freely. */
    stiffness = 1 / stiffness;
    for (i = 0; i < n; i++) {
        held[i] = (s->load[i] - held[i]) * stiffness;
        s->compression[i] += held[i];
    }
    for (k = 0; k < pair_rubber_terms; k++) {
        PAIR_REAL gain = (1 + kept[k]) / 2;
        for (i = 0; i < n; i++)
            s->branch[k][i] = kept[k] * s->branch[k][i] + gain * held[i] + pair_rubber_least;
    }
    return force;
}

/* Returns the force that parts the bodies, N, at the end of a step, s, with an approach, m, and its speed, m/s. */
static inline PAIR_REAL pair_rubber_force(pair_rubber_state *s, PAIR_REAL approach, PAIR_REAL approach_speed,
                                          PAIR_REAL step)
{
    PAIR_REAL force, slope;
    if (approach != approach) return approach;
    force = s->force = pair_rubber_repulsion(s, approach, step, &slope);
    (void)approach_speed;
    return force;
}

enum { pair_rubber_points = 17 };

/* Restitution, and contact time in s (infinite where the bodies stay together), at speeds in equal ratios. */
static const double pair_rubber_e[pair_rubber_points] = {
    8.655286602e-1, 8.648380659e-1, 8.641333336e-1, 8.634106635e-1, 8.626659128e-1, 8.618947491e-1,
    8.610928112e-1, 8.602558617e-1, 8.593799314e-1, 8.584614450e-1, 8.574973242e-1, 8.564850614e-1,
    8.554227642e-1, 8.543091631e-1, 8.531435853e-1, 8.519258935e-1, 8.506563938e-1};
static const double pair_rubber_T[pair_rubber_points] = {
    8.698250917e-4, 8.197154578e-4, 7.724943422e-4, 7.279959407e-4, 6.860634618e-4, 6.465487071e-4,
    6.093116799e-4, 5.742202166e-4, 5.411496344e-4, 5.099823899e-4, 4.806077479e-4, 4.529214550e-4,
    4.268254191e-4, 4.022273925e-4, 3.790406583e-4, 3.571837224e-4, 3.365800086e-4};

static inline double pair_rubber_of_v(const double *values, double speed)
{
    const double *ends = pair_rubber_speeds;
    double at = speed > ends[0] ? log(speed / ends[0]) / log(ends[1] / ends[0]) * (pair_rubber_points - 1) : 0;
    int i = at < pair_rubber_points - 2 ? (int)at : pair_rubber_points - 2;
    double share = at - i;
    if (!(share > 0)) return values[i];
    if (share >= 1) return values[i + 1];
    return values[i] + share * (values[i + 1] - values[i]);
}

/* Returns the restitution at a speed of approach, m/s, for codes without contact forces; constant outside of the range. */
static inline double pair_rubber_e_of_v(double speed)
{
    return pair_rubber_of_v(pair_rubber_e, speed);
}

/* Returns the contact time, s, at a speed of approach, m/s. */
static inline double pair_rubber_T_of_v(double speed)
{
    return pair_rubber_of_v(pair_rubber_T, speed);
}

#endif
