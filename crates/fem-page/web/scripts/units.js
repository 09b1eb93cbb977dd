// SI numbers as people read them: 65.12 µs, 2.31 GPa.

const PREFIXES = ['a', 'f', 'p', 'n', 'µ', 'm', '', 'k', 'M', 'G', 'T'];

// A number with a prefixed unit, so many digits; with the prefix and the decimals of another number, if one
// is given.
export function show(value, unit, digits = 4, like = value) {
  if (value === null || value === undefined) return '–';
  if (value === 0) return `0 ${unit}`.trim();
  if (unit === '') return withMinus(trimmed(value, digits));
  const exponent = Math.floor(Math.log10(Math.abs(like || value)));
  const power = Math.min(4, Math.max(-6, Math.floor(exponent / 3)));
  const scaled = value / 10 ** (3 * power);
  const number = like === value ? trimmed(scaled, digits) : scaled.toFixed(Math.max(0, digits - 1 - exponent + 3 * power));
  return `${withMinus(number)} ${PREFIXES[power + 6]}${unit}`;
}

// So many digits, without an exponent where the number is of the size that people write.
function trimmed(value, digits) {
  const text = value.toPrecision(digits);
  return text.includes('e') ? Number(text).toString() : text;
}

function withMinus(text) {
  return text.replace('-', '−');
}

// A share as a percentage.
export function percent(share) {
  const value = 100 * share;
  if (Math.abs(value) >= 0.0995) return `${value.toFixed(1)} %`.replace('-', '−');
  return value === 0 ? '0 %' : `${value.toPrecision(1)} %`.replace('-', '−');
}

// Rounded to what a slider shows and a case says.
export function rounded(value, digits = 3) {
  return Number(value.toPrecision(digits));
}
