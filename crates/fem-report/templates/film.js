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
  const play = document.createElement("button");
  const label = (text) => { play.textContent = text; };
  let timer = 0;
  const stop = () => { clearInterval(timer); timer = 0; label("Play"); };
  const next = () => {
    slider.value = (+slider.value + 1) % shots.length;
    show();
    if (+slider.value === shots.length - 1) stop();
  };
  play.addEventListener("click", () => {
    if (timer) { stop(); return; }
    timer = setInterval(next, 500);
    label("Pause");
  });
  label("Play");
  film.prepend(play, slider);
  film.classList.add("playing");
  show();
}
if (film?.querySelector(".mesh")) {
  const [label, box] = [document.createElement("label"), document.createElement("input")];
  box.type = "checkbox";
  box.addEventListener("change", () => film.classList.toggle("meshed", box.checked));
  label.append(box, " mesh");
  film.prepend(label);
  const play = film.querySelector("button");
  if (play) film.prepend(play);
}
addEventListener("beforeprint", () => document.querySelectorAll("details").forEach((one) => { one.open = true; }));
