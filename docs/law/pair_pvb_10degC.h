/* pair_pvb_10degC.h - contact law of one pair of bodies, C99 (and C++), SI units.
 * Ball of polyvinyl butyral, 10 mm, on a hard floor at 10 °C and 0.3 m/s
 * floor, rigid, ball 10.00 mm of lib:pvb
 *
 * Stands for: Ting's model with finite size.
 * Checked from 30.00 mm/s to 1.266 m/s, contact radius up to 0.092 of R*, 100 steps per contact: e within 0.0014,
 * contact time within 0.5 % and largest force within 0.25 % of that model. Take 50 steps or more.
 *
 *    speed, m/s         e   +/- law   +/- model   contact time, s
 *    3.00000e-2  0.80295   0.00121      0.0005     2.13555e-4
 *    4.78927e-2  0.79711   0.00125      0.0007     1.92728e-4
 *    7.64570e-2  0.79221   0.00129      0.0009     1.73794e-4
 *    1.22058e-1  0.78839   0.00126      0.0011     1.56601e-4
 *    1.94856e-1  0.78576   0.00124      0.0014     1.41008e-4
 *    3.11072e-1  0.78437   0.00123      0.0018     1.26884e-4
 *    4.96603e-1  0.78426   0.00120      0.0022     1.14100e-4
 *    7.92788e-1  0.78542   0.00129      0.0029     1.02536e-4
 *     1.26562e0  0.78779   0.00139      0.0036     9.20740e-5
 *
 * Made by fem-run 0.1.0: fem-run export CASE --law. Licence: MIT or Apache-2.0.
 *
 *   pair_pvb_10degC_state contact;                               one per contact, 2088 bytes in double
 *   pair_pvb_10degC_begin(&contact);                             first touch of two bodies
 *   force = pair_pvb_10degC_force(&contact, approach, approach_speed, step);     once in every step
 *   pair_pvb_10degC_end(&contact);                               the bodies have parted
 *
 * The approach is the overlap of the undeformed bodies at the end of the step, m, its speed is positive in closing, and a
 * positive force parts the bodies. Call it from first touch until the overlap is below -pair_pvb_10degC_reach. A contact may be
 * pressed again, held or let go at any time. Steps of any length are stable in the contact; the motion needs those named above.
 * #define PAIR_REAL float before the first header of this kind for single precision.
 */
#ifndef PAIR_PVB_10DEGC_H
#define PAIR_PVB_10DEGC_H

#include <math.h>

#ifndef PAIR_REAL
#define PAIR_REAL double
#endif

/* Effective radius, m, effective mass, kg, and contact modulus before relaxation, Pa. */
static const double pair_pvb_10degC_radius = 5.000000000e-3;
static const double pair_pvb_10degC_mass = 5.602506899e-4;
static const double pair_pvb_10degC_modulus = 1.546342466e9;
/* Distance of the surfaces up to which the contact may still hold, m. */
static const double pair_pvb_10degC_reach = 0.000000000e0;
/* Speeds between which the law was checked, m/s. */
static const double pair_pvb_10degC_speeds[2] = {3.000000000e-2, 1.265625000e0};

enum {
    pair_pvb_10degC_springs = 37, /* on the line x, from the middle outward */
    pair_pvb_10degC_terms = 5, /* of the relaxation, beside the part that stays */
    pair_pvb_10degC_iterations = 30
};

/* Approach at which each spring is reached, m, and its stiffness before relaxation, N/m. */
static const PAIR_REAL pair_pvb_10degC_gap[pair_pvb_10degC_springs] = {
    3.720285879e-9, 3.334544170e-8, 9.224499361e-8, 1.800545399e-7, 2.964125447e-7, 4.409607536e-7,
    6.133443885e-7, 8.132122526e-7, 1.040216787e-6, 1.294014101e-6, 1.574263982e-6, 1.880629897e-6,
    2.212778982e-6, 2.585829718e-6, 3.020709074e-6, 3.527384072e-6, 4.117355136e-6, 4.803872960e-6,
    5.602181088e-6, 6.529785969e-6, 7.606755952e-6, 8.856050295e-6, 1.030387867e-5, 1.198009083e-5,
    1.391859507e-5, 1.615780268e-5, 1.874109387e-5, 2.171729865e-5, 2.514118332e-5, 2.907393053e-5,
    3.358359705e-5, 3.874552983e-5, 4.464271644e-5, 5.870156036e-5, 8.570947879e-5, 1.233441226e-4,
    1.745281094e-4};
static const PAIR_REAL pair_pvb_10degC_stiffness[pair_pvb_10degC_springs] = {
    2.670411914e4, 2.670411914e4, 2.670411914e4, 2.670411914e4, 2.670411914e4, 2.670411914e4,
    2.670411914e4, 2.670411914e4, 2.670411914e4, 2.670411914e4, 2.670411914e4, 2.670411914e4,
    2.670411914e4, 2.892946240e4, 3.134025093e4, 3.395193851e4, 3.678126672e4, 3.984637228e4,
    4.316690330e4, 4.676414524e4, 5.066115734e4, 5.488292046e4, 5.945649716e4, 6.441120526e4,
    6.977880570e4, 7.559370617e4, 8.189318169e4, 8.871761349e4, 9.611074795e4, 1.041199769e5,
    1.127966417e5, 1.221963618e5, 1.323793920e5, 4.302330240e5, 5.377912799e5, 6.722390999e5,
    8.402988749e5};
/* Shares of the stiffness: one that stays and those that relax at a rate, 1/s. */
static const PAIR_REAL pair_pvb_10degC_equilibrium = (PAIR_REAL)4.757993359e-1;
static const PAIR_REAL pair_pvb_10degC_weight[pair_pvb_10degC_terms] = {4.049605537e-2, 9.537980253e-3, 2.720698373e-1, 7.753645356e-3, 8.022126750e-2};
static const PAIR_REAL pair_pvb_10degC_rate[pair_pvb_10degC_terms] = {4.903639824e2, 1.297809246e4, 3.867600703e4, 3.434813523e5, 1.023608611e6};
/* What a branch keeps at least, m: processors are slow with the smallest numbers, to which a contact at rest would relax. */
static const PAIR_REAL pair_pvb_10degC_least = (PAIR_REAL)1e-30;

/* All members are PAIR_REAL, so that a code can keep a contact as numbers; zeros are a contact that has not begun. */
typedef struct {
    PAIR_REAL force; /* of the springs in the last step, N */
    PAIR_REAL reached; /* number of springs that have been pressed */
    PAIR_REAL compression[pair_pvb_10degC_springs];
    PAIR_REAL load[pair_pvb_10degC_springs]; /* over the stiffness, m */
    PAIR_REAL branch[pair_pvb_10degC_terms][pair_pvb_10degC_springs];
} pair_pvb_10degC_state;

/* Ends a contact. The next one may begin at once. */
static inline void pair_pvb_10degC_end(pair_pvb_10degC_state *s)
{
    int i;
    s->force = 0;
    s->reached = 0;
    for (i = 0; i < pair_pvb_10degC_springs; i++) {
        int k;
        for (k = 0; k < pair_pvb_10degC_terms; k++) s->branch[k][i] = 0;
        s->compression[i] = s->load[i] = 0;
    }
}

/* Begins the first contact of two bodies, or one at a new spot. */
static inline void pair_pvb_10degC_begin(pair_pvb_10degC_state *s)
{
    pair_pvb_10degC_end(s);
}

/* What a branch keeps over a step at a rate, by the trapezoidal rule, limited where the step is too long for it. */
static inline PAIR_REAL pair_pvb_10degC_kept(PAIR_REAL rate, PAIR_REAL step)
{
    PAIR_REAL half = rate * step / 2;
    return half < 3 ? (1 - half) / (1 + half) : (PAIR_REAL)-0.5;
}

/* Sum of the springs at an approach, N, with what each holds if it keeps its compression. Springs only push. */
static inline PAIR_REAL pair_pvb_10degC_sum(pair_pvb_10degC_state *s, const PAIR_REAL *held, PAIR_REAL stiffness,
                                        PAIR_REAL approach, PAIR_REAL *slope)
{
    PAIR_REAL force = 0, rise = 0;
    int i, n = (int)s->reached;
    for (i = 0; i < n; i++) {
        PAIR_REAL load = held[i] + stiffness * (approach - pair_pvb_10degC_gap[i] - s->compression[i]);
        load = load > 0 ? load : 0;
        s->load[i] = load;
        force += pair_pvb_10degC_stiffness[i] * load;
    }
    *slope = rise * stiffness;
    return force;
}

/* Advances the springs by a step and returns their force, N, and their stiffness, N/m. */
static inline PAIR_REAL pair_pvb_10degC_repulsion(pair_pvb_10degC_state *s, PAIR_REAL approach, PAIR_REAL step,
                                              PAIR_REAL *slope)
{
    PAIR_REAL held[pair_pvb_10degC_springs];
    PAIR_REAL stiffness = pair_pvb_10degC_equilibrium, force;
    PAIR_REAL kept[pair_pvb_10degC_terms];
    int k;
    int i, n = (int)s->reached;
    while (n < pair_pvb_10degC_springs && pair_pvb_10degC_gap[n] < approach) n++;
    s->reached = (PAIR_REAL)n;
    for (i = 0; i < n; i++) held[i] = pair_pvb_10degC_equilibrium * s->compression[i];
    for (k = 0; k < pair_pvb_10degC_terms; k++) {
        PAIR_REAL share;
        kept[k] = pair_pvb_10degC_kept(pair_pvb_10degC_rate[k], step);
        share = pair_pvb_10degC_weight[k] * kept[k];
        stiffness += pair_pvb_10degC_weight[k] * (1 + kept[k]) / 2;
        for (i = 0; i < n; i++) held[i] += share * s->branch[k][i];
    }
    force = pair_pvb_10degC_sum(s, held, stiffness, approach, slope);
    /* A spring without load recovers freely. */
    stiffness = 1 / stiffness;
    for (i = 0; i < n; i++) {
        held[i] = (s->load[i] - held[i]) * stiffness;
        s->compression[i] += held[i];
    }
    for (k = 0; k < pair_pvb_10degC_terms; k++) {
        PAIR_REAL gain = (1 + kept[k]) / 2;
        for (i = 0; i < n; i++)
            s->branch[k][i] = kept[k] * s->branch[k][i] + gain * held[i] + pair_pvb_10degC_least;
    }
    return force;
}

/* Returns the force that parts the bodies, N, at the end of a step, s, with an approach, m, and its speed, m/s. */
static inline PAIR_REAL pair_pvb_10degC_force(pair_pvb_10degC_state *s, PAIR_REAL approach, PAIR_REAL approach_speed,
                                          PAIR_REAL step)
{
    PAIR_REAL force, slope;
    if (approach != approach) return approach;
    force = s->force = pair_pvb_10degC_repulsion(s, approach, step, &slope);
    (void)approach_speed;
    return force;
}

enum { pair_pvb_10degC_points = 17 };

/* Restitution, and contact time in s (infinite where the bodies stay together), at speeds in equal ratios. */
static const double pair_pvb_10degC_e[pair_pvb_10degC_points] = {
    8.029512875e-1, 7.999214884e-1, 7.971091380e-1, 7.945331932e-1, 7.922113186e-1, 7.901595825e-1,
    7.883921775e-1, 7.869211738e-1, 7.857563161e-1, 7.849048714e-1, 7.843715331e-1, 7.841583830e-1,
    7.842649110e-1, 7.846880881e-1, 7.854224870e-1, 7.864604421e-1, 7.877922399e-1};
static const double pair_pvb_10degC_T[pair_pvb_10degC_points] = {
    2.135551527e-4, 2.028950697e-4, 1.927281097e-4, 1.830341191e-4, 1.737938092e-4, 1.649886545e-4,
    1.566007960e-4, 1.486129501e-4, 1.410083275e-4, 1.337705644e-4, 1.268836665e-4, 1.203319689e-4,
    1.141001098e-4, 1.081730182e-4, 1.025359126e-4, 9.717430982e-5, 9.207403939e-5};

static inline double pair_pvb_10degC_of_v(const double *values, double speed)
{
    const double *ends = pair_pvb_10degC_speeds;
    double at = speed > ends[0] ? log(speed / ends[0]) / log(ends[1] / ends[0]) * (pair_pvb_10degC_points - 1) : 0;
    int i = at < pair_pvb_10degC_points - 2 ? (int)at : pair_pvb_10degC_points - 2;
    double share = at - i;
    if (!(share > 0)) return values[i];
    if (share >= 1) return values[i + 1];
    return values[i] + share * (values[i + 1] - values[i]);
}

/* Returns the restitution at a speed of approach, m/s, for codes without contact forces; constant outside of the range. */
static inline double pair_pvb_10degC_e_of_v(double speed)
{
    return pair_pvb_10degC_of_v(pair_pvb_10degC_e, speed);
}

/* Returns the contact time, s, at a speed of approach, m/s. */
static inline double pair_pvb_10degC_T_of_v(double speed)
{
    return pair_pvb_10degC_of_v(pair_pvb_10degC_T, speed);
}

#endif
