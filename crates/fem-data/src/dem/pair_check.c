/* Checks of a contact law: cc -std=c99 -O2 -include pair_NAME.h -DPAIR=pair_NAME [-DFRICTION] pair_check.c -lm
 *
 *   impacts        reads lines of speed and step, writes restitution, contact time and largest force of each impact
 *   walk N SEED DEPTH TIME RATE    moves at random for N steps, writes the least work over the largest, along the axis and across it
 *   oblique SPEED STEP SLIP MASS   an impact with a slip velocity of the patch, of a mass; writes the velocity after it
 *   rest SPEED STEP                drops the body under its weight, writes the largest gain of energy and the last, over the first
 *   cost SPEED STEP                writes ns per step of this law and of Hertz' spring with a dashpot
 */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define JOINED(a, b) a##b
#define JOIN(a, b) JOINED(a, b)
#define LAW(name) JOIN(PAIR, name)

typedef struct {
    LAW(_state) contact;
    double approach, rate, force, energy; /* energy: kinetic, and the work of the step by trapezoids */
} body;

/* A step of velocity Verlet under a pull, N. */
static void advance(body *b, double step, double pull)
{
    double mass = LAW(_mass);
    b->rate += step / 2 * (pull - b->force) / mass;
    b->approach += step * b->rate;
    b->force = LAW(_force)(&b->contact, b->approach, b->rate, step);
    b->rate += step / 2 * (pull - b->force) / mass;
}

static body touching(double speed)
{
    body b = {0};
    LAW(_begin)(&b.contact);
    b.rate = speed;
    return b;
}

static void impacts(void)
{
    double speed, step;
    while (scanf("%lf %lf", &speed, &step) == 2) {
        body b = touching(speed);
        double peak = 0;
        long n = 0;
        do {
            advance(&b, step, 0);
            if (b.force > peak) peak = b.force;
            n++;
        } while ((b.force != 0 || b.rate > 0) && b.approach > -LAW(_reach) && n < 100000);
        printf("%.12e %.12e %.12e\n", n < 100000 ? -b.rate / speed : 0, (n - 0.5) * step, peak);
    }
}

static uint64_t seed;
static double uniform(void)
{
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(seed >> 11) / 9007199254740992.0;
}

/* Loads, pauses, reversals and separations with steps from a thousandth of the time to thousands of it; each moves by at most a
 * two-hundredth of the depth, and not faster than a rate. */
static void walk(long n, double depth, double time, double rate)
{
    LAW(_state) contact;
    double approach = 0, target = 0, step = time, before = 0;
    double work[2] = {0, 0}, least[2] = {0, 0}, most[2] = {0, 0};
    double speed = 0;
    int k, pauses = 0;
#ifdef FRICTION
    PAIR_REAL shear[2] = {0, 0}, next[2], slip[2];
    double way[2] = {0, 0};
#endif
    LAW(_begin)(&contact);
    while (n-- > 0) {
        double move, force;
        if (fabs(target - approach) < 1e-3 * depth) {
            target = depth * (uniform() < 0.3 ? -0.2 : pow(uniform(), 2));
            speed = depth / (uniform() < 0.5 ? 200 : 2000);
            step = time / 200 * pow(10, 5 * uniform() - 3);
            pauses = uniform() < 0.3;
        }
        /* It begins with overlap. */
        if (before == 0 && approach == 0) speed = target = 0.3 * depth;
        move = fabs(target - approach) < speed ? target - approach : target > approach ? speed : -speed;
        if (pauses && uniform() < 0.5) move = 0;
        if (step < fabs(move) / rate) step = fabs(move) / rate;
        approach += move;
        force = LAW(_force)(&contact, approach, move / step, step);
        work[0] += (before + force) / 2 * move;
        before = force;
#ifdef FRICTION
        for (k = 0; k < 2; k++) {
            way[k] += 0.1 * (uniform() - 0.5) - 0.01 * way[k];
            slip[k] = (PAIR_REAL)(way[k] * depth / 100);
        }
        LAW(_tangential_force)(&contact, slip, step, next);
        for (k = 0; k < 2; k++) {
            work[1] += (shear[k] + next[k]) / 2 * slip[k];
            shear[k] = next[k];
        }
#endif
        for (k = 0; k < 2; k++) {
            if (!(work[k] == work[k])) exit(1);
            if (work[k] < least[k]) least[k] = work[k];
            if (work[k] > most[k]) most[k] = work[k];
        }
        if (approach < -LAW(_reach)) LAW(_end)(&contact);
    }
    printf("%.6e %.6e\n", least[0] / most[0], most[1] > 0 ? least[1] / most[1] : 0);
}

#ifdef FRICTION
static void oblique(double speed, double step, double velocity, double mass)
{
    body b = touching(speed);
    PAIR_REAL force[2] = {0, 0}, slip[2] = {0, 0};
    do {
        velocity -= step / 2 * force[0] / mass;
        slip[0] = (PAIR_REAL)(velocity * step);
        advance(&b, step, 0);
        LAW(_tangential_force)(&b.contact, slip, step, force);
        velocity -= step / 2 * force[0] / mass;
    } while (b.force != 0 || b.rate > 0);
    printf("%.12e\n", velocity);
}
#endif

static void rest(double speed, double step)
{
    body b = touching(speed);
    double mass = LAW(_mass), pull = 9.81 * mass, first = mass * speed * speed / 2, gain = 0, energy = first, least = first;
    long n;
    for (n = 0; n < 400000; n++) {
        advance(&b, step, pull);
        if (b.approach > 0 || b.force != 0) continue;
        energy = mass * b.rate * b.rate / 2 - pull * b.approach;
        if (energy - least > gain) gain = energy - least;
        if (energy < least) least = energy;
    }
    printf("%.6e %.6e\n", gain / first, (mass * b.rate * b.rate / 2) / first);
}

static double spring, damping;
static double hertz_dashpot(double approach, double rate)
{
    double root = approach > 0 ? sqrt(approach) : 0;
    return root * (spring * approach + damping * rate);
}

static double seconds(void)
{
    return (double)clock() / CLOCKS_PER_SEC;
}

static void cost(double speed, double step)
{
    double start, own, plain, mass = LAW(_mass), sum = 0;
    long n = 0, total = 0, k;
    spring = 4.0 / 3 * LAW(_modulus) * sqrt(LAW(_radius));
    damping = 1e-3 * spring * step;
    start = seconds();
    for (k = 0; k < 20000; k++) {
        body b = touching(speed);
        for (n = 0; n < 1000; n++) {
            advance(&b, step, 0);
            if (b.rate < 0 && b.force == 0) break;
        }
        total += n;
        sum += b.rate;
    }
    own = (seconds() - start) / total;
    start = seconds();
    for (k = 0, total = 0; k < 20000; k++) {
        double approach = 0, rate = speed, force = 0;
        for (n = 0; n < 1000; n++) {
            rate -= step / 2 * force / mass;
            approach += step * rate;
            force = hertz_dashpot(approach, rate);
            rate -= step / 2 * force / mass;
            if (rate < 0 && force <= 0) break;
        }
        total += n;
        sum += rate;
    }
    plain = (seconds() - start) / total;
    printf("%.3f %.3f %g\n", 1e9 * own, 1e9 * plain, sum);
}

int main(int n, char **words)
{
    double at[5] = {0};
    int k;
    for (k = 2; k < n && k < 7; k++) at[k - 2] = atof(words[k]);
    seed = (uint64_t)at[1];
    if (n > 1 && !strcmp(words[1], "impacts")) impacts();
    if (n > 1 && !strcmp(words[1], "walk")) walk((long)at[0], at[2], at[3], at[4]);
#ifdef FRICTION
    if (n > 1 && !strcmp(words[1], "oblique")) oblique(at[0], at[1], at[2], at[3]);
#endif
    if (n > 1 && !strcmp(words[1], "rest")) rest(at[0], at[1]);
    if (n > 1 && !strcmp(words[1], "cost")) cost(at[0], at[1]);
    return 0;
}
