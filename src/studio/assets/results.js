// The tables of claims and points, the proof of a point, and the files.
import { at, make } from "./api.js";

const CHECKED = {
  yes: "The answers are proved again by the independent checker.",
  part: "The answers are proved again by the independent checker, apart from what its certificate has no rule for.",
  "no-rule": "The certificate format has no rule for this: it was proved once.",
  "not-asked": "Not yet proved again by the checker.",
};

/** Exponents as they are set. */
const raised = text => text.replace(/C\^(\d+|k)/g, (_, order) => `C${[...order].map(d => "⁰¹²³⁴⁵⁶⁷⁸⁹"[d] ?? "ᵏ").join("")}`);
const chip = verdict => make("span", { class: `chip ${verdict === "undetermined" ? "undetermined-word" : verdict}` }, verdict);

export class Results {
  /** `picked` is called with the number of a point that is chosen, or `null`. */
  constructor(picked) {
    this.answer = null;
    this.number = null;
    this.picked = picked;
    at("close").addEventListener("click", () => this.pick(null));
  }

  stale(is) {
    for (const part of [document.querySelector("header"), at("claims"), at("found")]) part.toggleAttribute("data-stale", is);
  }

  /** Shows an answer; `last`: nothing more comes by itself. */
  show(answer, last) {
    this.answer = answer;
    at("verdict").replaceChildren(chip(answer.verdict));
    at("overall").textContent = raised(answer.overall ?? "");
    at("checked").textContent = CHECKED[answer.checked];
    const row = claim => make("tr", {},
      make("td", { class: "word" }, raised(claim.about)),
      make("td", { class: "word" }, chip(claim.verdict)),
      make("td", {}, raised(claim.text), claim.theorem ? make("span", { class: "reason" }, claim.theorem) : null,
        claim.reason && claim.verdict !== "proved" ? make("span", { class: "reason" }, raised(claim.reason)) : null));
    const limits = answer.limits.map(text => make("tr", {}, make("td", { colspan: 3, class: "soft" }, text)));
    const bad = (answer.bad ?? []).slice(0, 20).map(b => make("tr", {}, make("td", { colspan: 3 }, `face ${b.face}, line ${b.line}: ${b.what}`)));
    at("claim-rows").replaceChildren(...answer.claims.map(row), ...limits, ...bad);
    this.points(answer);
    this.files(answer);
    if (this.number !== null && last) this.pick(answer.points[this.number] ? this.number : null, true);
  }

  points(answer) {
    const row = (point, number) => {
      const tangent = point.tangent?.text ?? (point.tangent ? `(${point.tangent.exact.join(", ")})` : "–");
      const decimal = point.tangent?.decimal && point.tangent.lambda ? make("span", { class: "reason" }, `≈ (${point.tangent.decimal.join(", ")})`) : null;
      const name = make("button", { type: "button", onclick: () => this.pick(number) }, point.name);
      return make("tr", { "data-number": number, "aria-current": number === this.number ? "true" : null },
        make("td", { class: "word" }, name), make("td", {}, make("code", {}, point.address ?? "–")), make("td", { class: "word" }, point.parameter ?? "–"),
        make("td", { class: `word ${point.style}` }, point.kind === point.verdict ? point.kind : `${point.kind} (${point.verdict})`, point.note ? make("span", { class: "reason" }, point.note) : null), make("td", {}, tangent, decimal));
    };
    at("point-rows").replaceChildren(...answer.points.map(row));
    at("found").hidden = answer.points.length === 0;
    at("point-words").textContent = answer.left_out
      ? `The first ${answer.points.length} points; the report has ${answer.left_out} more.`
      : "Choose a point here or in the drawing to read its proof.";
  }

  files(answer) {
    const link = (name, label) => make("a", { href: `answer/${answer.id}/${name}?save`, download: "" }, label);
    const view = make("a", { href: `answer/${answer.id}/report`, target: "_blank", rel: "noopener" }, "Read the whole proof");
    at("files").replaceChildren(view, link("report", "Report"), link("case", "Case"), link("picture", "Picture (SVG)"), link("data", "Data (JSON)"),
      ...(answer.certificate ? [link("certificate", "Certificate")] : []),
      ...(answer.certificate && answer.expanded ? [link("expanded", "Expanded case, for the checker")] : []));
  }

  /** Opens the proof of a point. */
  pick(number, quiet = false) {
    this.number = number;
    at("proof").hidden = number === null;
    document.querySelectorAll("#point-rows tr").forEach(row => row.setAttribute("aria-current", row.dataset.number === `${number}`));
    this.picked(number);
    if (number === null) return;
    const point = this.answer.points[number];
    at("proof-title").textContent = `${point.name}, ${point.address}: ${point.kind}`;
    // Of a mesh there is one report.
    at("proof-page").src = point.normal !== undefined ? `answer/${this.answer.id}/report` : `answer/${this.answer.id}/point-${number}`;
    if (!quiet) at("proof-title").focus();
  }
}
