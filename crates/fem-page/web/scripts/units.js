// SI numbers as people read them: 65.12 µs, 2.31 GPa.

const PREFIXES = ['a', 'f', 'p', 'n', 'µ', 'm', '', 'k', 'M', 'G', 'T'];
const SUPERSCRIPTS = '⁰¹²³⁴⁵⁶⁷⁸⁹';

// Returns a number with a prefixed unit and this many digits; with the prefix and the decimals of `like` if that is
// of similar size.
export function show(value, unit, digits = 4, like = value) {
  if (value === null || value === undefined) return '–';
  if (value === 0) return `0 ${unit}`.trim();
  if (unit === '') return withMinus(trimmed(value, digits));
  const own = Number(value.toPrecision(digits));
  const { power, decimals } = scaleOf(like !== value && isLike(value, like) ? like : own, digits);
  return `${withMinus((own / 10 ** (3 * power)).toFixed(decimals))} ${PREFIXES[power + 6]}${unit}`;
}

// Returns the error of a number with two digits, in the unit of the number and with no more decimals if possible.
export function showBeside(off, value, unit) {
  if (!value || !off) return show(off, unit, 2);
  const { power, decimals } = unit === '' ? { power: 0, decimals: 4 } : scaleOf(value, 4);
  const scaled = Number(off.toPrecision(2)) / 10 ** (3 * power);
  const text = scaled.toFixed(Math.min(decimals, Math.max(0, 1 - Math.floor(Math.log10(scaled)))));
  return Number(text) === 0 ? show(off, unit, 1) : `${text} ${PREFIXES[power + 6]}${unit}`.trim();
}

function isLike(value, like) {
  return Number.isFinite(like) && Math.abs(value / like) >= 0.1 && Math.abs(value / like) <= 10;
}

// Returns the prefix with which a rounded number has one to three digits before the point, and its decimals.
function scaleOf(value, digits) {
  const exponent = Math.floor(Math.log10(Math.abs(Number(value.toPrecision(digits)))));
  const power = Math.min(4, Math.max(-6, Math.floor(exponent / 3)));
  return { power, decimals: Math.max(0, digits - 1 - exponent + 3 * power) };
}

// Returns this many digits, without an exponent for numbers of ordinary size.
function trimmed(value, digits) {
  const text = Number(value.toPrecision(digits)).toString();
  if (!text.includes('e')) return value.toPrecision(digits).includes('e') ? text : value.toPrecision(digits);
  const [mantissa, exponent] = text.split('e');
  const raised = [...String(Number(exponent))].map((letter) => (letter === '-' ? '⁻' : SUPERSCRIPTS[letter])).join('');
  return `${mantissa} × 10${raised}`;
}

function withMinus(text) {
  return text.replace('-', '−');
}

// Returns a sentence with numbers such as 2.8647e-4 m in readable form.
export function plain(text) {
  return text.replace(/(?<![\w.])(-?\d+(?:\.\d+)?e[-+]?\d+)(?: (m\/s|Pa|kg|[msNJ])(?![\w/]))?/g, (_, number, unit) => show(Number(number), unit ?? '', 3));
}

// Smaller shares count as zero.
export const NOTHING = 5e-7;

// Returns a share as a percentage.
export function percent(share) {
  const value = Math.abs(share) < NOTHING ? 0 : 100 * share;
  if (Math.abs(value) >= 0.0995) return `${value.toFixed(1)} %`.replace('-', '−');
  return value === 0 ? '0 %' : `${trimmed(value, 1)} %`.replace('-', '−');
}

// Rounds a value as sliders show it and cases contain it.
export function rounded(value, digits = 3) {
  return Number(value.toPrecision(digits));
}
