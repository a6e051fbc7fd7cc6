// The drawing: a canvas for the shape, and above it an SVG with the control points and the examined points.
import { at, make } from "./api.js";

const SIGNS = {
  tangent: () => make("circle", { class: "sign", r: 5 }),
  cusp: () => make("path", { class: "sign", d: "M0 -7L6.5 5H-6.5Z" }),
  corner: () => make("path", { class: "sign", d: "M-5 -5H5V5H-5Z" }),
  none: () => make("path", { class: "cross", d: "M-5 -5L5 5M-5 5L5 -5" }),
  undetermined: () => make("g", {}, make("circle", { class: "sign", r: 7.5 }), make("text", { y: 4 }, "?")),
};
const NAMES = { tangent: "tangent", cusp: "cusp", corner: "corner", none: "no tangent", undetermined: "undetermined" };
const PLANES = { ...NAMES, tangent: "tangent plane", none: "no tangent plane" };
/** Length of a ray, in pixels. */
const RAY = 46;

const dot = (a, b) => a.reduce((sum, x, k) => sum + x * (b[k] ?? 0), 0);

export class View {
  /** `act` has `moved(index, place)`, `stepped(index, steps)` and `picked(number)`. */
  constructor(act) {
    this.act = act;
    this.drawing = null;
    this.marks = [];
    this.places = [];
    this.handles = [];
    this.turn = [0.6, 0.5];
    this.middle = [0, 0, 0];
    this.scale = 1;
    this.stage = at("stage");
    this.polygon = make("path", { class: "polygon" });
    this.markGroup = make("g");
    this.handleGroup = make("g");
    at("overlay").append(this.polygon, this.markGroup, this.handleGroup);
    this.legend([]);
    new ResizeObserver(() => this.later()).observe(this.stage);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.later());
    this.listen();
  }

  get solid() {
    return this.drawing?.kind === "surface" || this.drawing?.kind === "mesh";
  }

  /** Directions to the right, up, and towards the eye. */
  axes() {
    if (!this.solid) return [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
    const [a, b] = this.turn;
    const [ca, sa, cb, sb] = [Math.cos(a), Math.sin(a), Math.cos(b), Math.sin(b)];
    return [[ca, sa, 0], [-sa * sb, ca * sb, cb], [sa * cb, -ca * cb, sb]];
  }

  /** Where a point is on the screen. */
  seen(point, axes = this.axes()) {
    const from = point.map((x, k) => x - this.middle[k]);
    const { clientWidth: w, clientHeight: h } = this.stage;
    return [w / 2 + dot(from, axes[0]) * this.scale, h / 2 - dot(from, axes[1]) * this.scale];
  }

  /** Shows a drawing; `fit` brings all of it into view. */
  show(drawing, places, fit) {
    const changed = this.drawing?.kind !== drawing.kind;
    this.drawing = drawing;
    at("overlay").toggleAttribute("hidden", drawing.kind === "vertices");
    at("solid").hidden = drawing.kind === "vertices";
    at("turning").hidden = !this.solid;
    at("words").textContent = drawing.words;
    at("overlay").setAttribute("aria-label", `${drawing.title}: control points and examined points`);
    if (drawing.kind !== "vertices") at("sheet").hidden = true;
    this.place(places);
    if (fit || changed) this.fit();
    this.later();
  }

  /** Control points, where they can be moved. */
  place(places) {
    const room = this.solid ? 3 : 2;
    const movable = this.drawing?.free && places.every(p => p.length === room || (!this.solid && p.length === 1));
    this.places = movable ? places.map(p => (p.length === 1 ? [p[0], 0] : p)) : [];
    while (this.handles.length > this.places.length) this.handles.pop().remove();
    while (this.handles.length < this.places.length) this.handles.push(this.handle(this.handles.length));
    this.later();
  }

  /** The examined points of an answer. */
  mark(points) {
    // What is no plain tangent lies above.
    const rank = p => Object.keys(SIGNS).indexOf(p.style);
    this.marks = points.filter(p => p.at).sort((a, b) => rank(a) - rank(b));
    this.reach = this.marks.length > 8 ? RAY / 2 : RAY;
    const group = this.marks.map(point => {
      const number = points.indexOf(point);
      const label = `${point.name}, ${point.address}: ${point.kind}, ${point.verdict}`;
      const element = make("g", { class: `mark ${point.style}`, tabindex: 0, role: "button", "aria-label": label, "data-number": number },
        make("path", { class: point.plane ? "plane" : "ray" }), make("g", { class: "place" }, make("circle", { class: "hit", r: 12 }), SIGNS[point.style]()));
      element.addEventListener("click", () => this.act.picked(number));
      element.addEventListener("keydown", event => {
        if (event.key === "Enter" || event.key === " ") {
          event.preventDefault();
          this.act.picked(number);
        }
      });
      return element;
    });
    this.markGroup.replaceChildren(...group);
    this.legend([...new Set(this.marks.map(p => p.style))]);
    this.later();
  }

  legend(styles) {
    const shown = Object.keys(SIGNS).filter(style => styles.includes(style));
    const sign = style => make("svg", { viewBox: "-9 -9 18 18", class: `mark ${style}`, "aria-hidden": "true" }, SIGNS[style]());
    at("legend").replaceChildren(...shown.map(style => make("li", {}, sign(style), (this.solid ? PLANES : NAMES)[style])));
  }

  current(number) {
    this.markGroup.querySelectorAll(".mark").forEach(m => m.setAttribute("aria-current", `${m.dataset.number}` === `${number}`));
  }

  stale(is) {
    this.stage.toggleAttribute("data-stale", is);
  }

  /** Brings everything into view. */
  fit() {
    const d = this.drawing;
    if (!d) return;
    // Of a surface control points may lie far away.
    const all = this.solid ? d.vertices : [...d.points, ...d.polygon, ...this.places].map(p => [p[0], p[1], 0]);
    if (all.length === 0) return;
    const low = [0, 1, 2].map(k => all.reduce((m, p) => Math.min(m, p[k]), Infinity));
    const high = [0, 1, 2].map(k => all.reduce((m, p) => Math.max(m, p[k]), -Infinity));
    this.middle = low.map((x, k) => (x + high[k]) / 2);
    const { clientWidth: w, clientHeight: h } = this.stage;
    const span = high.map((x, k) => x - low[k]);
    const room = this.solid ? Math.min(w, h) / Math.hypot(...span) : Math.min(w / span[0], h / span[1]);
    this.scale = Number.isFinite(room) && room > 0 ? room * (this.solid ? 0.7 : 0.84) : 100;
    this.later();
  }

  zoom(by) {
    this.scale *= by;
    this.later();
  }

  later() {
    if (this.waiting) return;
    this.waiting = requestAnimationFrame(() => {
      this.waiting = null;
      this.paint();
    });
  }

  paint() {
    const canvas = at("solid");
    const { clientWidth: w, clientHeight: h } = this.stage;
    const ratio = devicePixelRatio;
    canvas.width = Math.round(w * ratio);
    canvas.height = Math.round(h * ratio);
    const pen = canvas.getContext("2d");
    pen.scale(ratio, ratio);
    const d = this.drawing;
    if (!d) return;
    const style = getComputedStyle(document.documentElement);
    const colour = name => style.getPropertyValue(name).trim();
    if (this.solid) this.paintFaces(pen, colour);
    else this.paintFlat(pen, colour);
    this.paintOverlay();
  }

  paintFlat(pen, colour) {
    const { points, kind } = this.drawing;
    const axes = this.axes();
    pen.strokeStyle = pen.fillStyle = colour("--curve");
    if (kind === "set") {
      for (const point of points) {
        const [x, y] = this.seen(point, axes);
        pen.fillRect(x - 0.7, y - 0.7, 1.4, 1.4);
      }
      return;
    }
    pen.lineWidth = 2;
    pen.lineJoin = pen.lineCap = "round";
    pen.beginPath();
    points.forEach((point, k) => pen[k === 0 ? "moveTo" : "lineTo"](...this.seen(point, axes)));
    pen.stroke();
  }

  paintFaces(pen, colour) {
    const { vertices, faces } = this.drawing;
    const axes = this.axes();
    const flat = vertices.map(v => this.seen(v, axes));
    const depth = vertices.map(v => dot(v, axes[2]));
    const order = faces.map((corners, k) => [corners.reduce((sum, v) => sum + depth[v], 0) / corners.length, k]);
    order.sort((a, b) => a[0] - b[0]);
    const [front, back] = ["--face", "--back"].map(name => hex(colour(name)));
    pen.lineWidth = 0.6;
    for (const [, k] of order) {
      const corners = faces[k];
      const normal = cross(vertices, corners);
      const facing = dot(normal, axes[2]);
      const light = 0.6 + 0.5 * Math.abs(0.8 * facing + 0.45 * dot(normal, axes[1]) - 0.25 * dot(normal, axes[0]));
      const tone = (facing >= 0 ? front : back).map(x => Math.min(255, Math.round(x * light)));
      pen.fillStyle = pen.strokeStyle = `rgb(${tone.join(",")})`;
      pen.beginPath();
      corners.forEach((v, i) => pen[i === 0 ? "moveTo" : "lineTo"](...flat[v]));
      pen.closePath();
      pen.fill();
      pen.stroke();
    }
  }

  paintOverlay() {
    const axes = this.axes();
    const corners = this.places.length > 0 ? this.places : this.drawing.polygon;
    const line = this.solid ? [] : corners.map(p => this.seen(p, axes));
    this.polygon.setAttribute("d", line.map((p, k) => `${k === 0 ? "M" : "L"}${p[0].toFixed(1)} ${p[1].toFixed(1)}`).join(""));
    this.places.forEach((point, k) => {
      const [x, y] = this.seen(point, axes);
      this.handles[k].setAttribute("transform", `translate(${x.toFixed(1)} ${y.toFixed(1)})`);
      this.handles[k].setAttribute("aria-label", `Control point ${k} at ${point.map(c => +c.toFixed(4)).join(", ")}: arrow keys move it`);
    });
    this.marks.forEach((point, k) => {
      const element = this.markGroup.children[k];
      const [x, y] = this.seen(point.at, axes);
      element.querySelector(".place").setAttribute("transform", `translate(${x.toFixed(1)} ${y.toFixed(1)})`);
      element.firstChild.setAttribute("d", point.plane ? this.plane(point, axes) : this.rays(point, axes, x, y));
    });
  }

  /** The limit rays, as arrows; of a mesh its normal. */
  rays(point, axes, x, y) {
    const rays = point.rays ?? (point.normal ? [point.normal] : []);
    return rays.map(ray => {
      const v = this.solid ? [dot(ray, axes[0]), -dot(ray, axes[1])] : [ray[0], -ray[1]];
      const length = Math.hypot(...v);
      if (!(length > 0)) return "";
      const reach = this.solid ? RAY / 2 : this.reach / length;
      const [a, b] = v.map(c => c * reach);
      const head = length => [[-8, 4], [-8, -4]].map(([along, across]) => [x + a + (along * a - across * b) / length, y + b + (along * b + across * a) / length]);
      const wings = head(Math.hypot(a, b) || 1);
      const p = ([u, w]) => `${u.toFixed(1)} ${w.toFixed(1)}`;
      return `M${p([x, y])}L${p([x + a, y + b])}M${p(wings[0])}L${p([x + a, y + b])}L${p(wings[1])}`;
    }).join("");
  }

  /** A piece of the tangent plane. */
  plane(point, axes) {
    if (point.plane.length !== 2) return "";
    const [u, v] = orthogonal(point.plane[0], point.plane[1]);
    const reach = 17 / this.scale;
    const corner = (a, b) => this.seen(point.at.map((x, k) => x + reach * (a * u[k] + b * v[k])), axes).map(c => c.toFixed(1)).join(" ");
    return `M${corner(1, 1)}L${corner(1, -1)}L${corner(-1, -1)}L${corner(-1, 1)}Z`;
  }

  /** The element of a control point. */
  handle(index) {
    const element = make("g", { class: "handle", tabindex: 0, role: "button", "data-index": index },
      make("circle", { class: "hit", r: 15 }), make("circle", { class: "dot", r: 6.5 }), make("text", { x: 9, y: -9 }, `${index}`));
    let from = null;
    element.addEventListener("pointerdown", event => {
      event.stopPropagation();
      element.setPointerCapture(event.pointerId);
      from = { x: event.clientX, y: event.clientY, place: this.places[index], far: false };
    });
    element.addEventListener("pointermove", event => {
      if (!from) return;
      const [dx, dy] = [event.clientX - from.x, event.clientY - from.y];
      from.far ||= Math.hypot(dx, dy) > 3;
      if (!from.far) return;
      const axes = this.axes();
      const place = from.place.map((x, k) => x + (dx * axes[0][k] - dy * axes[1][k]) / this.scale);
      this.act.moved(index, place);
    });
    const end = event => {
      // A click on a control point at which a point was examined chooses that.
      if (from && !from.far && event.type === "pointerup") this.pick(event);
      from = null;
    };
    element.addEventListener("pointerup", end);
    element.addEventListener("pointercancel", end);
    element.addEventListener("keydown", event => {
      const along = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1], PageUp: [0, 0, 1], PageDown: [0, 0, -1] }[event.key];
      if (!along) return;
      event.preventDefault();
      this.act.stepped(index, along.map(step => step * (event.shiftKey ? 10 : 1)));
    });
    this.handleGroup.append(element);
    return element;
  }

  pick(event) {
    const box = this.stage.getBoundingClientRect();
    const here = [event.clientX - box.left, event.clientY - box.top];
    const axes = this.axes();
    const near = this.marks.map(p => this.seen(p.at, axes)).map(([x, y]) => Math.hypot(x - here[0], y - here[1]));
    const best = near.indexOf(Math.min(...near));
    if (best >= 0 && near[best] < 15) this.act.picked(Number(this.markGroup.children[best].dataset.number));
  }

  listen() {
    let from = null;
    this.stage.addEventListener("pointerdown", event => {
      if (event.target.closest(".mark")) return;
      from = [event.clientX, event.clientY];
      this.stage.setPointerCapture(event.pointerId);
    });
    this.stage.addEventListener("pointermove", event => {
      if (!from) return;
      const [dx, dy] = [event.clientX - from[0], event.clientY - from[1]];
      from = [event.clientX, event.clientY];
      if (this.solid && !event.shiftKey) {
        this.turned(-dx / 150, dy / 150);
      } else {
        const axes = this.axes();
        this.middle = this.middle.map((x, k) => x - (dx * axes[0][k] - dy * axes[1][k]) / this.scale);
      }
      this.later();
    });
    for (const name of ["pointerup", "pointercancel"]) this.stage.addEventListener(name, () => (from = null));
    this.stage.addEventListener("wheel", event => {
      if (!event.ctrlKey && document.documentElement.scrollHeight > innerHeight && !this.stage.matches(":focus-within")) return;
      event.preventDefault();
      this.zoom(Math.exp(-event.deltaY / 400));
    }, { passive: false });
    at("fit").addEventListener("click", () => this.fit());
    at("closer").addEventListener("click", () => this.zoom(1.25));
    at("farther").addEventListener("click", () => this.zoom(0.8));
    at("left").addEventListener("click", () => this.turned(-0.2, 0));
    at("right").addEventListener("click", () => this.turned(0.2, 0));
  }

  turned(a, b) {
    this.turn = [this.turn[0] + a, Math.max(-1.5, Math.min(1.5, this.turn[1] + b))];
    this.later();
  }
}

/** The unit normal of a face. */
function cross(vertices, corners) {
  const n = [0, 0, 0];
  corners.forEach((v, i) => {
    const [p, q] = [vertices[v], vertices[corners[(i + 1) % corners.length]]];
    n[0] += (p[1] - q[1]) * (p[2] + q[2]);
    n[1] += (p[2] - q[2]) * (p[0] + q[0]);
    n[2] += (p[0] - q[0]) * (p[1] + q[1]);
  });
  const length = Math.hypot(...n) || 1;
  return n.map(x => x / length);
}

/** Two unit vectors at a right angle that span the same plane. */
function orthogonal(a, b) {
  const unit = v => v.map(x => x / (Math.hypot(...v) || 1));
  const u = unit(a);
  return [u, unit(b.map((x, k) => x - dot(b, u) * u[k]))];
}

function hex(colour) {
  return [1, 3, 5].map(k => parseInt(colour.slice(k, k + 2), 16));
}
