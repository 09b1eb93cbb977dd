const film = document.querySelector(".film");
const shots = film ? [...film.querySelectorAll("figure")] : [];
if (shots.length > 1) {
  const slider = document.createElement("input");
  Object.assign(slider, { type: "range", min: 0, max: shots.length - 1, step: 1 });
  slider.setAttribute("aria-label", "instant");
  const show = () => {
    shots.forEach((shot, k) => shot.classList.toggle("now", k === +slider.value));
    slider.setAttribute("aria-valuetext", shots[slider.value].querySelector("figcaption").textContent);
  };
  slider.addEventListener("input", show);
  slider.value = film.dataset.opening;
  film.prepend(slider);
  film.classList.add("playing");
  show();
}
addEventListener("beforeprint", () => document.querySelectorAll("details").forEach((one) => { one.open = true; }));
