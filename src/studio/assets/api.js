// Requests to the server that sent this page. Addresses are relative, so that the token stays in them.

/** What went wrong, as the server says it. */
export class Trouble extends Error {
  constructor(error) {
    super(error.message);
    Object.assign(this, error);
  }
}

/** Sends an object and gives the answer; `signal` ends it, and with it the work on the server. */
export async function post(path, body, signal) {
  const response = await fetch(path, {
    method: "POST",
    headers: { "content-type": "application/json" },
    body: JSON.stringify(body),
    signal,
  });
  return answer(response);
}

/** Asks for an object. */
export async function get(path) {
  return answer(await fetch(path));
}

async function answer(response) {
  const type = response.headers.get("content-type") ?? "";
  const value = type.startsWith("application/json") ? await response.json() : {};
  if (response.ok) return value;
  throw new Trouble(value.error ?? { message: `The server refuses this (${response.status}).`, code: `${response.status}` });
}

/** An element of the page. */
export const at = id => document.getElementById(id);

/** Makes an element; nothing is ever read as HTML. */
export function make(name, attributes = {}, ...children) {
  const svg = ["svg", "g", "circle", "path", "text", "line", "polygon"].includes(name);
  const element = svg ? document.createElementNS("http://www.w3.org/2000/svg", name) : document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith("on")) element.addEventListener(key.slice(2), value);
    else if (value !== null && value !== undefined && value !== false) element.setAttribute(key, value === true ? "" : value);
  }
  element.append(...children.filter(child => child !== null && child !== undefined));
  return element;
}
