// The library of materials, as received from the module.

let library = [];

export function setMaterials(materials) {
  library = materials;
}

export function materialNames() {
  return library.map((material) => material.name);
}

export function material(name) {
  return library.find((entry) => entry.name === name);
}

export function allMaterials() {
  return library;
}

// Returns the table of a material in a case, with the chosen relaxation.
export function materialTable(name, relaxation) {
  const text = material(name).text.trimEnd();
  if (relaxation.kind === 'library') return text;
  const [moduli] = text.split(`\n[material.${name}.relaxation]`);
  if (relaxation.kind === 'none') return moduli.trimEnd();
  return `${moduli.trimEnd()}

[material.${name}.relaxation]
acts_on = "${relaxation.acts_on}"
terms = [{ weight = ${relaxation.weight}, relaxation_time = "${relaxation.time} us" }]`;
}
