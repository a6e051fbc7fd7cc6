// Shows the search, and hides the cards that it leaves out. The address keeps what was asked.
const form = document.querySelector("form.filters");
const cards = [...document.querySelectorAll(".cards li")].map((card) => ({
  card,
  text: card.textContent.toLowerCase(),
  verdict: card.dataset.verdict,
  kinds: card.dataset.kinds.split(";"),
}));
const fields = ["text", "verdict", "kind"];

function apply() {
  const [text, verdict, kind] = fields.map((name) => form.elements[name].value);
  const words = text.toLowerCase().split(/\s+/).filter(Boolean);
  let shown = 0;
  for (const c of cards) {
    const fits =
      words.every((word) => c.text.includes(word)) && (!verdict || c.verdict === verdict) && (!kind || c.kinds.includes(kind));
    c.card.hidden = !fits;
    shown += fits;
  }
  for (const section of document.querySelectorAll("section")) {
    section.hidden = !section.querySelector("li:not([hidden])");
  }
  form.querySelector("output").textContent = shown === cards.length ? "" : `${shown} of ${cards.length} cases`;
  const asked = new URLSearchParams(fields.map((name) => [name, form.elements[name].value]).filter(([, value]) => value));
  history.replaceState(null, "", asked.size ? `#${asked}` : location.pathname + location.search);
}

for (const [name, value] of new URLSearchParams(location.hash.slice(1))) {
  if (fields.includes(name)) form.elements[name].value = value;
}
form.hidden = false;
form.addEventListener("input", apply);
form.addEventListener("submit", (event) => event.preventDefault());
apply();
