/* pair_steel.h - contact law of one pair of bodies, C99 (and C++), SI units.
 * Balls of steel 4340, 10 mm, at 1 m/s
 * struck 10.00 mm of lib:steel-4340, ball 10.00 mm of lib:steel-4340
 *
 * Stands for: the law mean_pressure, a fit to finite elements.
 * Checked from 100.0 mm/s to 10.00 m/s, contact radius up to 0.23 of R*, 100 steps per contact: e within 0.0031,
 * contact time within 0.5 % and largest force within 0.33 % of that model. Take 50 steps or more.
 *
 *    speed, m/s         e   +/- law   +/- model   contact time, s
 *    1.00000e-1  0.98142   0.00066      0.0211     4.69827e-5
 *    1.77828e-1  0.94631   0.00102      0.0213     4.13174e-5
 *    3.16228e-1  0.90009   0.00069      0.0212     3.64618e-5
 *    5.62341e-1  0.84705   0.00033      0.0214     3.23165e-5
 *     1.00000e0  0.78812   0.00004      0.0211     2.87672e-5
 *     1.77828e0  0.72735   0.00032      0.0206     2.57285e-5
 *     3.16228e0  0.66621   0.00149      0.0203     2.31158e-5
 *     5.62341e0  0.60483   0.00306      0.0207     2.08705e-5
 *     1.00000e1  0.54101   0.00264      0.0207     1.89442e-5
 *
 * Made by fem-run 0.1.0: fem-run export CASE --law. Licence: MIT or Apache-2.0.
 *
 *   pair_steel_state contact;                               one per contact, 48 bytes in double
 *   pair_steel_begin(&contact);                             first touch of two bodies
 *   force = pair_steel_force(&contact, approach, approach_speed, step);     once in every step
 *   pair_steel_end(&contact);                               the bodies have parted
 *
 * The approach is the overlap of the undeformed bodies at the end of the step, m, its speed is positive in closing, and a
 * positive force parts the bodies. Call it from first touch until the overlap is below -pair_steel_reach. A contact may be
 * pressed again, held or let go at any time. Steps of any length are stable in the contact; the motion needs those named above.
 * #define PAIR_REAL float before the first header of this kind for single precision.
 */
#ifndef PAIR_STEEL_H
#define PAIR_STEEL_H

#include <math.h>

#ifndef PAIR_REAL
#define PAIR_REAL double
#endif

/* Effective radius, m, effective mass, kg, and contact modulus before relaxation, Pa. */
static const double pair_steel_radius = 2.500000000e-3;
static const double pair_steel_mass = 2.055125194e-3;
static const double pair_steel_modulus = 1.153846154e11;
/* Distance of the surfaces up to which the contact may still hold, m. */
static const double pair_steel_reach = 0.000000000e0;
/* Speeds between which the law was checked, m/s. */
static const double pair_steel_speeds[2] = {1.000000000e-1, 1.000000000e1};

enum { pair_steel_knots = 64 };

/* Hertz' stiffness, N/m^(3/2), up to first yield; approach at first yield, m; logarithm of the ratio of neighbouring approaches. */
static const PAIR_REAL pair_steel_hertz = (PAIR_REAL)7.692307692e9;
static const PAIR_REAL pair_steel_yield = (PAIR_REAL)8.241045131e-7;
static const PAIR_REAL pair_steel_ratio = (PAIR_REAL)9.003660119e-2;
/* Flow stress over that of the table as a power of the speed of first touch over a speed, m/s. */
static const PAIR_REAL pair_steel_rate[2] = {9.053130718e-3, 1.000000000e0};
/* At each approach: logarithm of the force in N, length of the rebound over the approach, exponent of the rebound. */
static const PAIR_REAL pair_steel_dent[pair_steel_knots][3] = {
    {1.750033947e0, 1.000000000e0, 1.500000000e0},
    {1.885088849e0, 1.000000000e0, 1.500000000e0},
    {2.020143751e0, 1.000000000e0, 1.500000000e0},
    {2.155198653e0, 1.000000000e0, 1.500000000e0},
    {2.290451646e0, 9.920471011e-1, 1.490020433e0},
    {2.425350716e0, 9.820564568e-1, 1.479037635e0},
    {2.559762274e0, 9.712797223e-1, 1.468684916e0},
    {2.693625160e0, 9.597483553e-1, 1.458932280e0},
    {2.826891392e0, 9.475027751e-1, 1.449751080e0},
    {2.959524106e0, 9.345897768e-1, 1.441113957e0},
    {3.091495765e0, 9.210603847e-1, 1.432994786e0},
    {3.222786619e0, 9.069680990e-1, 1.425368620e0},
    {3.353383390e0, 8.923674896e-1, 1.418211645e0},
    {3.483278153e0, 8.773130883e-1, 1.411501136e0},
    {3.612467376e0, 8.618585350e-1, 1.405215418e0},
    {3.740951120e0, 8.460559358e-1, 1.399333829e0},
    {3.868732355e0, 8.299553959e-1, 1.393836691e0},
    {3.995816385e0, 8.136046941e-1, 1.388705279e0},
    {4.122210361e0, 7.970490712e-1, 1.383921803e0},
    {4.247922874e0, 7.803311091e-1, 1.379469379e0},
    {4.372963613e0, 7.634906787e-1, 1.375332018e0},
    {4.497343072e0, 7.465649427e-1, 1.371494607e0},
    {4.621072307e0, 7.295883974e-1, 1.367942904e0},
    {4.744162729e0, 7.125929457e-1, 1.364663523e0},
    {4.866625932e0, 6.956079890e-1, 1.361643937e0},
    {4.988473545e0, 6.786605348e-1, 1.358872472e0},
    {5.109717105e0, 6.617753124e-1, 1.356338314e0},
    {5.230367948e0, 6.449748933e-1, 1.354031511e0},
    {5.350437124e0, 6.282798133e-1, 1.351942988e0},
    {5.469935308e0, 6.117086945e-1, 1.350064558e0},
    {5.588872736e0, 5.952783638e-1, 1.348388945e0},
    {5.707259140e0, 5.790039691e-1, 1.346909805e0},
    {5.825103692e0, 5.628990901e-1, 1.345621755e0},
    {5.942414952e0, 5.469758453e-1, 1.344520409e0},
    {6.059200822e0, 5.312449924e-1, 1.343602419e0},
    {6.175468494e0, 5.157160254e-1, 1.342865521e0},
    {6.291224407e0, 5.003972642e-1, 1.342308591e0},
    {6.406474204e0, 4.852959412e-1, 1.341931704e0},
    {6.521222678e0, 4.704182813e-1, 1.341736208e0},
    {6.635473730e0, 4.557695780e-1, 1.341724802e0},
    {6.749230311e0, 4.413542647e-1, 1.341901631e0},
    {6.862494372e0, 4.271759817e-1, 1.342272380e0},
    {6.975266800e0, 4.132376394e-1, 1.342844398e0},
    {7.087547355e0, 3.995414775e-1, 1.343626818e0},
    {7.199334599e0, 3.860891212e-1, 1.344630710e0},
    {7.310625816e0, 3.728816340e-1, 1.345869235e0},
    {7.421416930e0, 3.599195671e-1, 1.347357831e0},
    {7.531702404e0, 3.472030074e-1, 1.349114415e0},
    {7.641475139e0, 3.347316219e-1, 1.351159610e0},
    {7.750726356e0, 3.225047008e-1, 1.353516998e0},
    {7.859445470e0, 3.105211980e-1, 1.356213408e0},
    {7.967619942e0, 2.987797707e-1, 1.359279233e0},
    {8.075235126e0, 2.872788174e-1, 1.362748794e0},
    {8.182274091e0, 2.760165138e-1, 1.366660740e0},
    {8.288717428e0, 2.649908495e-1, 1.371058505e0},
    {8.394543034e0, 2.541996621e-1, 1.375990823e0},
    {8.499725876e0, 2.436406718e-1, 1.381512308e0},
    {8.604237724e0, 2.333115158e-1, 1.387684110e0},
    {8.708046859e0, 2.232097817e-1, 1.394574665e0},
    {8.811117753e0, 2.133330415e-1, 1.402260541e0},
    {8.913410707e0, 2.036788862e-1, 1.410827412e0},
    {9.014881452e0, 1.942449595e-1, 1.420371162e0},
    {9.115480715e0, 1.850289935e-1, 1.430999160e0},
    {9.215153728e0, 1.760288437e-1, 1.442831727e0}};

/* All members are PAIR_REAL, so that a code can keep a contact as numbers; zeros are a contact that has not begun. */
typedef struct {
    PAIR_REAL force; /* of the springs in the last step, N */
    PAIR_REAL deepest, peak; /* largest approach ever, m, and the force there, N */
    PAIR_REAL length, exponent; /* of the rebound from it */
    PAIR_REAL strength; /* flow stress over that of the table */
} pair_steel_state;

/* Ends a contact. The dent stays: call it, and not _begin, where the next contact is at the same spot. */
static inline void pair_steel_end(pair_steel_state *s)
{
    s->force = 0;
}

/* Begins the first contact of two bodies, or one at a new spot. */
static inline void pair_steel_begin(pair_steel_state *s)
{
    s->deepest = s->peak = s->length = 0;
    s->exponent = 1;
    s->strength = 0;
    pair_steel_end(s);
}

/* Presses a spot deeper than ever and keeps its force and rebound. */
static inline void pair_steel_press(pair_steel_state *s, PAIR_REAL approach)
{
    PAIR_REAL scale = s->strength * s->strength, at, share;
    const PAIR_REAL *low, *high;
    int i;
    s->deepest = approach;
    approach /= scale;
    if (approach <= pair_steel_yield) {
        s->peak = pair_steel_hertz * approach * (PAIR_REAL)sqrt(approach) * scale * s->strength;
        s->length = s->deepest;
        s->exponent = (PAIR_REAL)1.5;
        return;
    }
    at = (PAIR_REAL)log(approach / pair_steel_yield) / pair_steel_ratio;
    i = at < pair_steel_knots - 2 ? (int)at : pair_steel_knots - 2;
    low = pair_steel_dent[i];
    high = pair_steel_dent[i + 1];
    share = at - i;
    s->peak = (PAIR_REAL)exp(low[0] + share * (high[0] - low[0])) * scale * s->strength;
    if (share > 1) share = 1;
    s->length = s->deepest * (low[1] + share * (high[1] - low[1]));
    s->exponent = low[2] + share * (high[2] - low[2]);
}

/* Returns the force of the first loading, or of the elastic rebound from the largest approach, N. */
static inline PAIR_REAL pair_steel_repulsion(pair_steel_state *s, PAIR_REAL approach, PAIR_REAL approach_speed)
{
    PAIR_REAL height;
    if (approach <= 0) return 0;
    if (!(s->strength > 0)) {
        s->strength = 1;
        if (approach_speed > 0)
            s->strength = (PAIR_REAL)pow(approach_speed / pair_steel_rate[1], pair_steel_rate[0]);
    }
    if (approach > s->deepest) {
        pair_steel_press(s, approach);
        return s->peak;
    }
    height = (approach - s->deepest) / s->length + 1;
    return height > 0 ? s->peak * (PAIR_REAL)pow(height, s->exponent) : 0;
}

/* Returns the force that parts the bodies, N, at the end of a step, s, with an approach, m, and its speed, m/s. */
static inline PAIR_REAL pair_steel_force(pair_steel_state *s, PAIR_REAL approach, PAIR_REAL approach_speed,
                                          PAIR_REAL step)
{
    PAIR_REAL force = s->force = pair_steel_repulsion(s, approach, approach_speed);
    (void)step;
    return force;
}

enum { pair_steel_points = 17 };

/* Restitution, and contact time in s (infinite where the bodies stay together), at speeds in equal ratios. */
static const double pair_steel_e[pair_steel_points] = {
    9.814211274e-1, 9.655877839e-1, 9.463125967e-1, 9.242734326e-1, 9.000857213e-1, 8.742394454e-1,
    8.470485304e-1, 8.179388555e-1, 7.881232087e-1, 7.578596635e-1, 7.273534769e-1, 6.967634333e-1,
    6.662066761e-1, 6.356828369e-1, 6.048330265e-1, 5.729311367e-1, 5.410069091e-1};
static const double pair_steel_T[pair_steel_points] = {
    4.698266201e-5, 4.404354052e-5, 4.131743576e-5, 3.879441695e-5, 3.646184865e-5, 3.430760156e-5,
    3.231654977e-5, 3.047218270e-5, 2.876722867e-5, 2.718969450e-5, 2.572852061e-5, 2.437361195e-5,
    2.311583003e-5, 2.195101024e-5, 2.087047244e-5, 1.987066761e-5, 1.894416301e-5};

static inline double pair_steel_of_v(const double *values, double speed)
{
    const double *ends = pair_steel_speeds;
    double at = speed > ends[0] ? log(speed / ends[0]) / log(ends[1] / ends[0]) * (pair_steel_points - 1) : 0;
    int i = at < pair_steel_points - 2 ? (int)at : pair_steel_points - 2;
    double share = at - i;
    if (!(share > 0)) return values[i];
    if (share >= 1) return values[i + 1];
    return values[i] + share * (values[i + 1] - values[i]);
}

/* Returns the restitution at a speed of approach, m/s, for codes without contact forces; constant outside of the range. */
static inline double pair_steel_e_of_v(double speed)
{
    return pair_steel_of_v(pair_steel_e, speed);
}

/* Returns the contact time, s, at a speed of approach, m/s. */
static inline double pair_steel_T_of_v(double speed)
{
    return pair_steel_of_v(pair_steel_T, speed);
}

#endif
