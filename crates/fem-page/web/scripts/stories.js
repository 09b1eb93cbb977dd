// Four stories. Each step sets the sliders, explains the result with the numbers of this run, and may show a
// chart of many collisions.
import { percent, show } from './units.js';
import { FIRST, caseOf, sound } from './scene.js';

const twins = (state) => ({ ...state, 'partner.diameter': state['striker.diameter'] });

// Returns n values from one to another, with equal ratios.
function ratios(from, to, n) {
  return Array.from({ length: n }, (_, k) => from * (to / from) ** (k / (n - 1)));
}

export const STORIES = [
  {
    title: 'Why is the restitution below one?',
    steps: [
      {
        set: { 'relaxation.kind': 'none' },
        text: ({ restitution, crossings }) => `First, glass without relaxation. The spheres separate with ${show(restitution, '', 6)} of their approach speed: all stored energy is returned. (Do they not vibrate? Sound crosses the striker ${Math.round(crossings)} times during the contact, so the body deforms like a spring and keeps almost no vibration. This model neglects vibration; choose explicit finite elements under Model, which include it, and compare.)`,
      },
      {
        set: {},
        text: ({ restitution, heat, time, relaxationTime }) => `Now the glass relaxes: at constant strain its stress decays with a relaxation time of ${show(relaxationTime, 's', 3)}. The contact lasts only ${percent(time / relaxationTime)} of that, but during separation the glass pushes slightly less than during approach. ${percent(heat)} of the kinetic energy of the approach becomes heat. The rest is the square of the restitution: ${show(restitution, '')}² = ${percent(restitution ** 2)}. Compare the force with Hertz: it peaks earlier and is weaker at the end.`,
      },
      {
        set: { 'relaxation.kind': 'term', 'relaxation.time': 100 },
        text: ({ restitution, relaxationTime }) => `With a shorter relaxation time, ${show(relaxationTime, 's', 3)}, the restitution falls to ${show(restitution, '')}. What matters is the ratio of contact time to relaxation time. On the right of the chart the glass has no time to relax; on the left it relaxes fully.`,
        chart: {
          x: 'relaxation time [µs]',
          y: 'restitution',
          logarithmic: [true, false],
          along: ratios(30, 30000, 10),
          change: (value) => ({ 'relaxation.kind': 'term', 'relaxation.time': value }),
          of: (summary) => summary.restitution,
          compare: [{ label: 'elastic', of: () => 1 }],
        },
      },
    ],
  },
  {
    title: 'Why does the contact time hardly depend on speed?',
    steps: [
      {
        set: { 'relaxation.kind': 'none', 'speed': 0.1 },
        text: ({ time }) => `At 0.1 m/s the spheres touch for ${show(time, 's')}. If they were springs of constant stiffness, this time would be the same at every speed, like the period of a pendulum.`,
      },
      {
        set: { 'relaxation.kind': 'none', 'speed': 1 },
        text: ({ time }) => `At ten times the speed: ${show(time, 's')}. Under a larger force the spheres touch over a larger circle and become stiffer, so the contact is shorter, but only with the fifth root of the speed: ten times the speed leaves ${percent(10 ** -0.2)} of the time.`,
        chart: {
          x: 'speed [m/s]',
          y: 'contact time [µs]',
          logarithmic: [true, true],
          along: ratios(0.02, 5, 10),
          change: (value) => ({ 'relaxation.kind': 'none', 'speed': value }),
          of: (summary) => 1e6 * summary.contact_time_s,
          compare: [{ label: 'Hertz, slope −1/5', of: (summary) => 1e6 * summary.hertz.contact_time_s }],
        },
      },
    ],
  },
  {
    title: 'Why do small and large spheres differ?',
    steps: [
      {
        set: { 'striker.diameter': 2, 'partner.diameter': 2 },
        text: ({ restitution, time }) => `Two glass spheres of 2 mm touch for ${show(time, 's')} and have a restitution of ${show(restitution, '')}. At a given speed the contact time is proportional to the size, since all lengths scale together.`,
      },
      {
        set: { 'striker.diameter': 100, 'partner.diameter': 100 },
        text: ({ restitution, time, relaxationTime }) => `Spheres of 100 mm touch for ${show(time, 's')}. The relaxation time is still ${show(relaxationTime, 's', 3)}, so the glass now has time to relax: the restitution is ${show(restitution, '')}. Elastic spheres would give the same restitution at every size, because their material has no time scale.`,
        chart: {
          x: 'diameter of both [mm]',
          y: 'restitution',
          logarithmic: [true, false],
          along: ratios(1, 200, 10),
          change: (value) => twins({ 'striker.diameter': value }),
          of: (summary) => summary.restitution,
          compare: [{ label: 'elastic', of: () => 1 }],
        },
      },
    ],
  },
  {
    title: 'What did the paper measure?',
    steps: [
      {
        set: {},
        text: ({ restitution }) => `Bordbar and Hyppänen (2007) let a glass sphere of 22.2 mm strike one of 15.9 mm in a Newton’s cradle at 0.5 m/s and measured a restitution of 0.925. Their own finite elements gave 0.92. The result here is ${show(restitution, '')}.`,
      },
      {
        set: { 'relaxation.kind': 'term', 'relaxation.acts_on': 'shear', 'relaxation.time': 369 },
        text: ({ restitution }) => `The paper does not say whether volume relaxes like shape. If only shape relaxes, the restitution is ${show(restitution, '')}, much further from the measurement. The paper therefore probably means the first reading.`,
      },
      {
        set: {},
        text: () => 'A single measurement cannot distinguish between kinds of loss. With relaxation the restitution grows with speed, because fast contacts are short; plastic flow or cracks would make it fall. Several speeds or sizes are needed to decide.',
        chart: {
          x: 'speed [m/s]',
          y: 'restitution',
          logarithmic: [true, false],
          along: ratios(0.05, 5, 10),
          range: [0.85, 1],
          change: (value) => ({ speed: value }),
          of: (summary) => summary.restitution,
          measured: [{ label: 'measured, 2007', points: [[0.5, 0.925]] }, { label: 'the paper’s elements', points: [[0.5, 0.92]] }],
        },
      },
    ],
  },
];

// Returns the state of a step: the paper's pair with the settings of the step.
export function stateOf(step) {
  return sound({ ...FIRST, ...step.set });
}

// Returns the chart of a step; `compute` returns the summary of a case.
export async function chartOf(step, compute) {
  const { x, y, logarithmic, range = null, along, change, of, compare = [], measured = [] } = step.chart;
  const own = [];
  const others = compare.map(() => []);
  for (const value of along) {
    const summary = await compute(caseOf(sound({ ...FIRST, ...step.set, ...change(value) })));
    if (!summary) return null;
    const point = Number(value.toPrecision(4));
    own.push([point, of(summary)]);
    compare.forEach((other, k) => others[k].push([point, other.of(summary)]));
  }
  const curves = [
    { label: 'computed here', mark: 'line', points: own },
    ...compare.map(({ label }, k) => ({ label, mark: 'dashed', points: others[k] })),
    ...measured.map(({ label, points }) => ({ label, mark: 'points', points })),
  ];
  return { x, y, logarithmic, range, curves };
}
