// What follows what: every change asks for a drawing and for a first proof at once, then for a quick one; when nothing changes
// for a moment, for a proof with the normal budget and for the checker, in the background, until it is there or is stopped.
import { at, get, make, post } from "./api.js";
import { Inputs } from "./input.js";
import { Results } from "./results.js";
import { View } from "./view.js";

/** A quick proof of something older may go on this long, so that the verdict follows a drag too. */
const PATIENCE = 150;
/** Nothing has changed for so long: time for the slower proof. */
const SETTLED = 300;

const page = Array.from(crypto.getRandomValues(new Uint8Array(12)), b => b.toString(16).padStart(2, "0")).join("");
let now = 0;
let drawn = 0;
let drawing = false;
let proved = 0;
let proving = null;
let later = null;
let background = null;
let fit = true;

const results = new Results(number => view.current(number));
const view = new View({
  moved: (index, place) => inputs.moved(index, place),
  stepped: (index, steps) => inputs.stepped(index, steps),
  picked: number => results.pick(number),
});
let inputs;

/** The coloured parts of a slider, or nothing where they are not known. */
const regions = new Map();
function region(name, parameter) {
  const key = `${name} ${parameter}`;
  if (!regions.has(key)) regions.set(key, post("api/region", { page, name, parameter }).catch(() => (regions.delete(key), null)));
  return regions.get(key);
}

function say(text) {
  at("status").textContent = text;
}

function problem(error) {
  at("problem").hidden = error === null;
  if (error === null) return;
  const place = error.line ? ` (line ${error.line}, column ${error.column})` : "";
  at("problem").replaceChildren(make("p", {}, `${error.message}${place}`), ...(error.help ? [make("p", { class: "soft" }, error.help)] : []));
}

function changed() {
  now += 1;
  clearTimeout(later);
  background?.abort();
  at("harder").hidden = true;
  results.stale(true);
  view.stale(true);
  if (inputs) view.place(inputs.places());
  pump();
}

/** Starts what is due. */
function pump() {
  if (!inputs) return;
  if (!drawing && drawn < now) draw();
  if (!proving && proved < now) quick();
  else if (proving && proving.of < now) {
    const age = performance.now() - proving.since;
    if (age > PATIENCE) proving.control.abort();
    else setTimeout(pump, PATIENCE - age + 1);
  }
}

async function draw() {
  const of = now;
  drawing = true;
  try {
    const found = await post("api/draw", { input: inputs.current() });
    if (of === now) {
      inputs.shown(found);
      view.stale(false);
    }
    view.show(found, inputs.places(), fit);
    fit = false;
    if (of === now) problem(null);
  } catch (error) {
    if (of === now) problem(error);
  }
  drawing = false;
  drawn = of;
  pump();
}

/** The tangents at once; then, where nothing has changed, with a little more of a search. */
async function quick() {
  const of = now;
  const { since, control } = (proving = { of, since: performance.now(), control: new AbortController() });
  const input = inputs.current();
  try {
    for (const effort of ["first", "quick"]) {
      const found = await post("api/prove", { page, input, effort }, control.signal);
      show(found, of, performance.now() - since);
      if (of !== now || found.claims.every(claim => claim.verdict !== "undetermined")) break;
    }
    if (of === now) later = setTimeout(() => slower("normal"), SETTLED);
  } catch (error) {
    if (of === now) failed(error);
  }
  proving = null;
  // What was given up for something newer is not asked again.
  proved = of;
  pump();
}

function show(found, of, time, last = false) {
  results.show(found, last);
  view.mark(found.points);
  view.current(results.number);
  results.stale(of !== now);
  if (view.drawing?.kind === "vertices" || found.points.length === 0 && found.claims.some(c => c.about.startsWith("valence"))) {
    at("sheet").src = `answer/${found.id}/picture`;
    at("sheet").hidden = false;
  }
  say(`${["first", "quick"].includes(found.effort) ? "Answered" : `Answered with the ${found.effort} budget`} in ${Math.round(time)} ms.`);
}

function failed(error) {
  if (error.name === "AbortError") return;
  problem(error);
  say(error.code === "secant::stopped" ? "Stopped." : "No answer.");
}

/** A proof in the background; it is shown that it goes on, and can be stopped. */
async function slower(effort) {
  const of = now;
  const control = new AbortController();
  const since = performance.now();
  background = control;
  say(`Proving with the ${effort} budget, and asking the checker …`);
  at("stop").hidden = false;
  at("harder").hidden = true;
  try {
    const found = await post("api/prove", { page, input: inputs.current(), effort, check: true }, control.signal);
    if (of === now) {
      show(found, of, performance.now() - since, true);
      at("harder").hidden = effort === "hard" || found.claims.every(claim => claim.verdict !== "undetermined");
    }
  } catch (error) {
    if (of === now && !control.signal.aborted) failed(error);
  }
  if (background === control) {
    background = null;
    at("stop").hidden = true;
  }
}

at("stop").addEventListener("click", async () => {
  await post("api/stop", { page }).catch(() => null);
  background?.abort();
  say("Stopped. What is undetermined stays so until more is asked.");
  at("harder").hidden = false;
});
at("harder").addEventListener("click", () => slower("hard"));
// What is chosen anew is brought into view; what is dragged stays where it is.
const anew = () => (fit = true);
for (const id of ["scheme", "example", "mesh", "refined-by", "file", "where", "text"]) {
  for (const name of ["change", "input"]) at(id).addEventListener(name, anew, { capture: true });
}
at("anew").addEventListener("click", anew, { capture: true });
document.querySelectorAll("input[name=kind]").forEach(radio => radio.addEventListener("change", anew, { capture: true }));

try {
  inputs = new Inputs(await get("api/catalogue"), changed, region);
  changed();
} catch (error) {
  problem(error);
}
