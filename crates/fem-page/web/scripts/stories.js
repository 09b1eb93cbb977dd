// Four stories. A step sets the sliders, says what comes out in numbers of this very run, and may show a
// chart of many collisions.
import { percent, show } from './units.js';
import { FIRST, caseOf, sound } from './scene.js';

const twins = (state) => ({ ...state, 'partner.diameter': state['striker.diameter'] });

// n values from one to another, in equal ratios.
function ratios(from, to, n) {
  return Array.from({ length: n }, (_, k) => from * (to / from) ** (k / (n - 1)));
}

export const STORIES = [
  {
    title: 'Why is the restitution below one?',
    steps: [
      {
        set: { 'relaxation.kind': 'none' },
        text: ({ restitution, crossings }) => `First glass without any relaxation. The spheres part with ${show(restitution, '', 6)} of the speed at which they met: all that was stored is given back. (Do they not ring? Sound crosses the striker ${Math.round(crossings)} times during the contact, so the body follows as a spring does, and keeps next to nothing. This model leaves ringing out; take explicit elements under Model, which have it, and compare.)`,
      },
      {
        set: {},
        text: ({ restitution, heat, time, relaxationTime }) => `Now the glass relaxes: a stress that is held decays with a time of ${show(relaxationTime, 's', 3)}. The contact lasts only ${percent(time / relaxationTime)} of that, but on the way out the glass pushes a little less than it did on the way in. ${percent(heat)} of the energy of the motion towards each other turns to heat. What is left is the square of the restitution: ${show(restitution, '')}² = ${percent(restitution ** 2)}. Compare the force with Hertz: its peak comes earlier, and its tail is weaker.`,
      },
      {
        set: { 'relaxation.kind': 'term', 'relaxation.time': 100 },
        text: ({ restitution, relaxationTime }) => `Quicker relaxation, ${show(relaxationTime, 's', 3)}: the restitution falls to ${show(restitution, '')}. What counts is the contact time over the relaxation time. Far to the right of the chart the glass has no time to relax; to the left it has more than enough.`,
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
        text: ({ time }) => `At 0.1 m/s the spheres touch for ${show(time, 's')}. Were they springs of a fixed stiffness, that time would be the same at any speed, as for a pendulum.`,
      },
      {
        set: { 'relaxation.kind': 'none', 'speed': 1 },
        text: ({ time }) => `Ten times faster: ${show(time, 's')}. Pressed harder, the spheres touch over a larger circle, and so get stiffer: the contact is shorter, but only by the fifth root of the speed. A tenfold speed leaves ${percent(10 ** -0.2)} of the time.`,
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
    title: 'Why do small spheres and big ones differ?',
    steps: [
      {
        set: { 'striker.diameter': 2, 'partner.diameter': 2 },
        text: ({ restitution, time }) => `Two glass spheres of 2 mm touch for ${show(time, 's')}, and come back with ${show(restitution, '')}. At one speed the contact time goes with the size: all lengths grow alike.`,
      },
      {
        set: { 'striker.diameter': 100, 'partner.diameter': 100 },
        text: ({ restitution, time, relaxationTime }) => `Of 100 mm they touch for ${show(time, 's')}. The glass has the same clock as before, ${show(relaxationTime, 's', 3)}, and now the time to use it: the restitution is ${show(restitution, '')}. An elastic pair would give the same at any size: without a clock in the material there is nothing to compare the contact time with.`,
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
        text: ({ restitution }) => `Bordbar and Hyppänen (2007) let a glass sphere of 22.2 mm strike one of 15.9 mm in a Newton’s cradle at 0.5 m/s, and measured a restitution of 0.925. Their own finite elements print 0.92. Here it is ${show(restitution, '')}.`,
      },
      {
        set: { 'relaxation.kind': 'term', 'relaxation.acts_on': 'shear', 'relaxation.time': 369 },
        text: ({ restitution }) => `The paper does not say whether volume relaxes as shape does. If only shape does: ${show(restitution, '')}, much further from what was measured. So the reading before is likely the paper’s.`,
      },
      {
        set: {},
        text: () => 'One measured point cannot tell one loss from another. Relaxation makes the restitution grow with speed, since fast contacts are short; a loss by flow or by cracks would make it fall. It takes several speeds or sizes to know.',
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

// The state of a step: that of the paper's pair with what the step sets.
export function stateOf(step) {
  return sound({ ...FIRST, ...step.set });
}

// The chart of a step, as its collisions come in; `compute` gives the summary of a case.
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
