// The panel of what is asked: scheme and sliders, text, mesh, control points. All numbers are texts of exact numbers; the page
// rounds a place of the pointer to its grid and reckons nothing else.
import { at, make } from "./api.js";

/** The nearest point of the grid, exactly. */
const onGrid = x => {
  const over = Number(at("grid").value);
  const count = Math.round(x * over);
  return over === 1 ? `${count}` : `${count}/${over}`;
};

/** About how large the number is that a text means. */
const size = text => {
  const [above, below] = `${text}`.split("/");
  return Number(above) / (below === undefined ? 1 : Number(below));
};

export class Inputs {
  /** `changed` is called after every change; `region(name, parameter)` promises the parts of a slider. */
  constructor(catalogue, changed, region) {
    this.catalogue = catalogue;
    this.region = region;
    this.changed = changed;
    this.parameters = {};
    this.points = null;
    this.control = null;
    this.file = null;
    this.fill();
    this.listen();
    this.choose();
  }

  get kind() {
    return document.querySelector("input[name=kind]:checked").value;
  }

  get entry() {
    const [kind, name] = at("scheme").value.split(":");
    return [kind, this.catalogue[kind].find(entry => entry.name === name)];
  }

  /** What is asked now. */
  current() {
    const points = at("at").value.split(",").map(text => text.trim()).filter(text => text !== "");
    const where = at("where").value;
    const control = where === "none" ? "none" : this.points ? { points: this.points } : "suggested";
    if (this.kind === "mesh") {
      return { kind: "mesh", text: this.file?.text ?? this.catalogue.meshes[at("mesh").value].text, off: this.file?.off ?? false, scheme: at("refined-by").value };
    }
    if (this.kind === "text") return { kind: "text", text: at("text").value, control, at: points };
    const [kind, entry] = this.entry;
    const parameters = { ...this.parameters };
    if (kind === "rules") {
      const valence = parameters.valence;
      delete parameters.valence;
      return { kind: "rule", name: entry.name, parameters, valence };
    }
    const ends = at("ends").value === "" ? {} : { ends: at("ends").value };
    return { kind: "scheme", name: entry.name, parameters, control, at: points, ...ends };
  }

  fill() {
    const group = (label, kind) =>
      make("optgroup", { label }, ...this.catalogue[kind].map(s => make("option", { value: `${kind}:${s.name}` }, s.name)));
    at("scheme").append(group("Curves and sets", "schemes"), group("Mesh rules, at a vertex", "rules"));
    at("scheme").value = "schemes:four-point";
    const list = items => items.map((item, k) => make("option", { value: k }, item.title));
    at("example").append(make("option", { value: "" }, "–"), ...list(this.catalogue.examples));
    at("mesh").append(...list(this.catalogue.meshes));
    at("refined-by").append(...this.catalogue.refined_by.map(name => make("option", { value: name }, name)));
    at("text").value = this.catalogue.examples[0].text;
  }

  listen() {
    const anew = () => {
      this.points = null;
      this.changed();
    };
    document.querySelectorAll("input[name=kind]").forEach(radio => radio.addEventListener("change", () => this.choose()));
    at("scheme").addEventListener("change", () => this.choose());
    at("example").addEventListener("change", event => {
      if (event.target.value !== "") at("text").value = this.catalogue.examples[event.target.value].text;
      anew();
    });
    let wait;
    const soon = action => () => {
      clearTimeout(wait);
      wait = setTimeout(action, 120);
    };
    at("text").addEventListener("input", soon(anew));
    at("at").addEventListener("input", soon(() => this.changed()));
    at("mesh").addEventListener("change", () => {
      this.file = null;
      at("file").value = "";
      at("mesh-name").textContent = "";
      this.changed();
    });
    at("file").addEventListener("change", () => this.read(at("file").files[0]));
    at("refined-by").addEventListener("change", () => this.changed());
    at("where").addEventListener("change", anew);
    at("ends").addEventListener("change", () => this.changed());
    at("anew").addEventListener("click", anew);
    at("more").addEventListener("click", () => this.more());
    at("fewer").addEventListener("click", () => {
      if (this.control?.length > 2) this.set(this.control.slice(0, -1));
    });
  }

  async read(file) {
    if (!file) return;
    if (file.size > 4 << 20) {
      at("mesh-name").textContent = `${file.name} is larger than 4 MiB: certify it on the command line.`;
      return;
    }
    this.file = { text: await file.text(), off: file.name.toLowerCase().endsWith(".off") };
    at("mesh-name").textContent = file.name;
    this.changed();
  }

  /** Shows the panel of the kind and of the scheme that are chosen. */
  choose() {
    for (const kind of ["scheme", "text", "mesh"]) at(`by-${kind}`).hidden = kind !== this.kind;
    const [kind, entry] = this.entry;
    at("ends-row").hidden = this.kind !== "scheme" || kind === "rules";
    at("further").hidden = this.kind === "mesh" || (this.kind === "scheme" && kind === "rules");
    at("ends").value = "";
    this.points = null;
    const list = kind === "rules"
      ? [{ name: "valence", summary: "faces at the vertex; 3..12 for several", value: "5", values: [...Array(30).keys()].map(n => `${n + 3}`) }, ...entry.parameters]
      : entry.parameters;
    at("summary").textContent = `${entry.summary}. ${entry.source}.`;
    this.parameters = Object.fromEntries(list.filter(p => p.needed || p.name === "valence" || kind === "schemes").map(p => [p.name, p.value]));
    at("sliders").replaceChildren(...list.map(parameter => this.slider(parameter)));
    if (this.kind === "scheme" && kind === "schemes" && list.length === 1 && list[0].values.some(text => text.includes("/"))) this.colour(entry, list[0]);
    this.changed();
  }

  /** A slider over exact numbers, with a field for any other. */
  slider(parameter) {
    const { name, summary, values, value } = parameter;
    const whole = values.every(text => !text.includes("/"));
    const place = text => {
      const near = values.reduce((best, v, k) => (Math.abs(size(v) - size(text)) < Math.abs(size(values[best]) - size(text)) ? k : best), 0);
      return `${near}`;
    };
    const id = `parameter-${name}`;
    const range = make("input", { type: "range", min: 0, max: values.length - 1, step: 1, id, "aria-valuetext": value ?? "" });
    range.value = value === null ? "0" : place(value);
    const field = make("input", { type: "text", class: "number", "aria-label": `${name}, exactly`, value: value ?? "" });
    const set = text => {
      this.parameters[name] = text;
      range.setAttribute("aria-valuetext", text);
      // Another number of control points.
      if (whole) this.points = null;
      this.changed();
    };
    range.addEventListener("input", () => {
      field.value = values[Number(range.value)];
      set(field.value);
    });
    field.addEventListener("change", () => {
      range.value = place(field.value);
      set(field.value.trim());
    });
    // The slot is for intervals of the parameter with their verdicts, see `colour`.
    return make("div", { class: "slider" }, make("label", { for: id }, `${name}: ${summary}`), range, field, make("div", { class: "slot", hidden: true, "data-parameter": name }));
  }

  /** Colours the slot of a slider by where the scheme converges and is smooth, for all control points. */
  async colour(entry, parameter) {
    const found = await this.region(entry.name, parameter.name);
    const slot = document.querySelector(`.slot[data-parameter="${parameter.name}"]`);
    // Another scheme may have been chosen meanwhile.
    if (!found || !slot || this.entry[1] !== entry || this.kind !== "scheme") return;
    const bar = ({ order, parts }) => {
      const label = order === 0 ? "converges" : `C${[...`${order}`].map(d => "⁰¹²³⁴⁵⁶⁷⁸⁹"[d]).join("")}`;
      const said = verdict => parts.filter(p => p.verdict === verdict).map(p => p.text).join("; ");
      const told = ["proved", "refuted", "undetermined"].filter(v => said(v) !== "").map(v => `${v}: ${said(v)}`).join(". ");
      const pieces = parts.map(part => {
        const piece = make("i", { class: `${part.verdict}-part`, title: `${label}, ${part.verdict}: ${part.text}` });
        piece.style.left = `${part.from * 100}%`;
        piece.style.width = `${(part.to - part.from) * 100}%`;
        return piece;
      });
      return make("div", { class: "order" }, make("b", {}, label), make("div", { class: "bar", role: "img", "aria-label": `${label}, for all control points. ${told}` }, ...pieces));
    };
    slot.replaceChildren(...found.orders.map(bar), make("p", { class: "soft" }, `green: proved for all control points; red: refuted; striped: undetermined`));
    slot.hidden = found.orders.length === 0;
  }

  /** Other control points. */
  set(points) {
    this.points = points;
    this.control = points;
    this.list();
    this.changed();
  }

  /** A control point was moved to about here. */
  moved(index, place) {
    this.set(this.control.map((point, k) => (k === index ? point.map((text, i) => (place[i] === null ? text : onGrid(place[i]))) : point)));
  }

  /** A control point goes some steps of the grid along its coordinates. */
  stepped(index, steps) {
    const over = Number(at("grid").value);
    this.moved(index, this.control[index].map((text, i) => size(text) + (steps[i] ?? 0) / over));
  }

  more() {
    const last = this.control?.at(-1);
    if (last) this.set([...this.control, last.map((text, i) => (i === 0 ? onGrid(size(text) + 1) : text))]);
  }

  /** Takes over the control points of a drawing. */
  shown(drawing) {
    this.control = drawing.control;
    at("control").hidden = !drawing.free;
    for (const id of ["more", "fewer", "anew"]) at(id).disabled = drawing.control === null;
    this.list();
  }

  /** The coordinates as fields; those that are there are kept, so that none loses the focus. */
  list() {
    const points = this.control ?? [];
    const rows = at("coordinates").children;
    const fits = rows.length === points.length && points.every((p, k) => rows[k].querySelectorAll("input").length === p.length);
    if (!fits) {
      at("coordinates").replaceChildren(...points.map((point, k) =>
        make("div", { class: "row" }, make("span", {}, `${k}`), ...point.map((_, i) =>
          make("input", { type: "text", class: "number", "aria-label": `Control point ${k}, coordinate ${"xyz"[i] ?? i}`, onchange: event =>
            this.set(this.control.map((p, j) => (j === k ? p.map((text, l) => (l === i ? event.target.value.trim() : text)) : p))) })))));
    }
    points.forEach((point, k) => {
      const fields = at("coordinates").children[k].querySelectorAll("input");
      point.forEach((text, i) => {
        if (fields[i] !== document.activeElement) fields[i].value = text;
      });
    });
  }

  /** The control points as floats, for the drawing. */
  places() {
    return (this.control ?? []).map(point => point.map(size));
  }
}
