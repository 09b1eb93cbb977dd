// Sliders, fields and choices, and their state.
import { rounded } from './units.js';
import { SLIDERS, isMeant } from './scene.js';
import { element } from './results.js';

function placeOf(key, value) {
  const { from, to, isLogarithmic } = SLIDERS[key];
  return Math.round(1000 * (isLogarithmic ? Math.log(value / from) / Math.log(to / from) : (value - from) / (to - from)));
}

function valueAt(key, place) {
  const { from, to, isLogarithmic } = SLIDERS[key];
  const part = place / 1000;
  return rounded(isLogarithmic ? from * (to / from) ** part : from + (to - from) * part);
}

// Builds a slider with a number field. `moved` and `set` receive a change of the state, `refuse` a fault.
export function buildSlider(box, { moved, set, refuse }) {
  const { key, label } = box.dataset;
  const { from, to, unit } = SLIDERS[key];
  const id = `slider-${key.replace('.', '-')}`;
  const slider = element('input', '', { type: 'range', id, min: 0, max: 1000, step: 1 });
  const number = element('input', '', { type: 'number', min: from, max: to, step: 'any', inputmode: 'decimal', 'aria-label': unit ? `${label} in ${unit}` : label, 'aria-describedby': `${id}-fault` });
  const fault = element('p', '', { class: 'field-fault', id: `${id}-fault`, hidden: '' });
  box.append(element('label', label, { for: id }), slider, number, element('span', unit, { class: 'unit' }), fault);
  slider.addEventListener('input', () => moved({ [key]: valueAt(key, slider.value) }));
  slider.addEventListener('change', () => set({ [key]: valueAt(key, slider.value) }));
  number.addEventListener('change', () => {
    const value = Number(number.value);
    const isWithin = number.value !== '' && value >= from && value <= to;
    if (isWithin) {
      markFault(box, null);
      set({ [key]: value });
      return;
    }
    const range = `Between ${from} and ${to} ${unit}`.trim();
    markFault(box, `${range}.`);
    refuse({ message: `${label}: ${number.value || 'no number'} is not allowed`, help: `${range}. Your own case, below, may use other values.` });
  });
}

function markFault(box, text) {
  const fault = box.querySelector('.field-fault');
  fault.textContent = text ?? '';
  fault.hidden = text === null;
  box.querySelector('input[type="number"]').setAttribute('aria-invalid', String(text !== null));
  if (text !== null) fault.scrollIntoView({ block: 'nearest' });
}

// Shows a state in the controls; they are disabled while a case of the reader is shown.
export function refreshControls(state, isOwn) {
  for (const box of document.querySelectorAll('.slider')) {
    const { key } = box.dataset;
    const [slider, number] = box.querySelectorAll('input');
    slider.value = placeOf(key, state[key]);
    slider.setAttribute('aria-valuetext', `${state[key]} ${SLIDERS[key].unit}`.trim());
    number.value = state[key];
    markFault(box, null);
    box.hidden = !isMeant(key, state);
  }
  for (const select of document.querySelectorAll('select[data-key]')) {
    select.value = state[select.dataset.key];
    select.parentElement.hidden = !isMeant(select.dataset.key, state);
  }
  for (const fieldset of document.querySelectorAll('#controls fieldset')) fieldset.disabled = isOwn;
}
