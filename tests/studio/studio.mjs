// The page of `secant studio` in Chromium: node studio.mjs PROGRAM [DIRECTORY for screenshots]
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdtemp, readFile, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { createInterface } from "node:readline";
import { chromium } from "playwright-core";

const [program, kept] = process.argv.slice(2);
const scratch = await mkdtemp(join(tmpdir(), "secant-studio-"));
const shots = kept ?? scratch;
const server = spawn(program, ["studio", "--no-open"], { stdio: ["ignore", "pipe", "inherit"] });
const address = (await createInterface({ input: server.stdout })[Symbol.asyncIterator]().next()).value;
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"],
});

/** A new page; what it complains about, and whom it asks, is remembered. */
async function opened(options = {}) {
  const context = await browser.newContext({ viewport: { width: 1400, height: 900 }, acceptDownloads: true, ...options });
  const page = await context.newPage();
  const complaints = [];
  page.on("pageerror", error => complaints.push(`${error}`));
  page.on("console", message => {
    // Refusals are answers with a status of their own, which the browser writes down too.
    if (message.type() === "error" && !message.text().includes("status of 4")) complaints.push(message.text());
  });
  page.on("request", request => {
    if (!request.url().startsWith(address) && !request.url().startsWith("data:") && !request.url().startsWith("about:")) complaints.push(`asks ${request.url()}`);
  });
  // While the page is worked on, its parts can be taken from here.
  if (process.env.STUDIO_ASSETS) {
    await page.route(/\/([a-z]+\.(js|css))?$/, async route => {
      const name = new URL(route.request().url()).pathname.split("/").pop() || "index.html";
      await route.fulfill({ path: join(process.env.STUDIO_ASSETS, name) });
    });
  }
  await page.goto(address);
  await settled(page);
  return { page, complaints, context };
}

/** Waits until nothing is asked any more. */
async function settled(page) {
  await page.waitForFunction(() => {
    const said = document.getElementById("status").textContent;
    const open = document.querySelector("#claims[data-stale]");
    return document.getElementById("stop").hidden && !open && (said.includes("normal budget in") || said.startsWith("No answer"));
  }, null, { timeout: 60_000 });
}

const claim = (page, about) => page.evaluate(about => {
  const row = [...document.querySelectorAll("#claim-rows tr")].find(tr => tr.cells[0].textContent.includes(about));
  return row?.cells[1]?.textContent;
}, about);

async function saved(page, name) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("link", { name, exact: true }).click()]);
  const path = join(scratch, download.suggestedFilename());
  await download.saveAs(path);
  return [download.suggestedFilename(), await readFile(path, "utf8")];
}

const wide = page => page.evaluate(() => document.documentElement.scrollWidth > innerWidth);

const steps = {
  async "the first scheme is answered and checked"() {
    const { page, complaints, context } = await opened();
    assert.equal(await claim(page, "ends"), "proved");
    assert.match(await page.textContent("#checked"), /proved again by the independent checker/);
    assert.ok(await page.locator(".mark").count() >= 3);
    assert.equal(await page.evaluate(() => {
      const canvas = document.getElementById("solid");
      return canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.some(x => x > 0);
    }), true);
    assert.deepEqual(complaints, []);
    await context.close();
  },

  async "a slider gives exact numbers and another verdict"() {
    const { page, complaints, context } = await opened();
    await page.locator("#parameter-w").focus();
    await page.keyboard.press("End");
    await settled(page);
    assert.equal(await page.inputValue("[aria-label='w, exactly']"), "1/4");
    const before = await claim(page, "G¹");
    await page.fill("[aria-label='w, exactly']", "0.05");
    await page.keyboard.press("Enter");
    await settled(page);
    assert.equal(await claim(page, "G¹"), "proved");
    assert.notEqual(before, "proved");
    await page.fill("[aria-label='w, exactly']", "1/0");
    await page.keyboard.press("Enter");
    await page.waitForSelector("#problem:not([hidden])");
    assert.deepEqual(complaints, []);
    await context.close();
  },

  async "the slider is coloured where the scheme is smooth"() {
    const { page, complaints, context } = await opened();
    await page.waitForSelector(".slot:not([hidden]) .bar .proved-part", { timeout: 60_000 });
    assert.match(await page.getAttribute(".slot .order:nth-child(2) .bar", "aria-label"), /^C¹, for all control points. proved: 0 to .*0\.1927/);
    await page.screenshot({ path: join(shots, "region.png") });
    assert.deepEqual(complaints, []);
    await context.close();
  },

  async "a mask is pasted, a point dragged, and the verdict changes"() {
    const { page, complaints, context } = await opened();
    await page.check("input[value=text]");
    await page.fill("#text", "1/4, 3/4, 3/4, 1/4");
    await settled(page);
    assert.equal(await claim(page, "G¹"), "proved");
    await page.screenshot({ path: join(shots, "mask.png") });
    // A control point on the one before: the curve has a corner there.
    const [from, to] = [await page.locator(".handle").nth(2).boundingBox(), await page.locator(".handle").nth(1).boundingBox()];
    const middle = box => [box.x + 15, box.y + box.height - 15];
    await page.mouse.move(...middle(from));
    await page.mouse.down();
    await page.mouse.move(...middle(to), { steps: 12 });
    await page.mouse.up();
    await settled(page);
    for (const coordinate of ["x", "y"]) {
      const [moved, other] = await Promise.all([2, 1].map(k => page.inputValue(`[aria-label='Control point ${k}, coordinate ${coordinate}']`)));
      assert.equal(moved, other);
    }
    assert.equal(await claim(page, "G¹"), "refuted");
    assert.ok(await page.locator(".mark.corner").count() >= 1);
    await page.screenshot({ path: join(shots, "corner.png") });
    assert.deepEqual(complaints, []);
    await context.close();
  },

  async "the keyboard alone moves a point and opens a proof"() {
    const { page, complaints, context } = await opened();
    await page.locator(".handle").nth(1).focus();
    const before = await page.inputValue("[aria-label='Control point 1, coordinate y']");
    await page.keyboard.press("ArrowUp");
    await settled(page);
    assert.notEqual(await page.inputValue("[aria-label='Control point 1, coordinate y']"), before);
    assert.equal(await page.evaluate(() => document.activeElement.getAttribute("data-index")), "1");
    await page.locator(".mark").nth(0).focus();
    await page.keyboard.press("Enter");
    const proof = page.frameLocator("#proof-page");
    await proof.locator("text=Conclusion").first().waitFor();
    assert.ok(await proof.locator("math").count() > 3);
    await page.screenshot({ path: join(shots, "proof.png"), fullPage: true });
    assert.deepEqual(complaints, []);
    await context.close();
  },

  async "files are downloaded"() {
    const { page, complaints, context } = await opened();
    assert.match((await saved(page, "Case"))[1], /\[scheme\]\nname = "four-point"/);
    assert.match((await saved(page, "Report"))[1], /<math/);
    assert.match((await saved(page, "Picture (SVG)"))[1], /^<svg/);
    assert.equal(JSON.parse((await saved(page, "Data (JSON)"))[1]).version, 1);
    const [name, certificate] = await saved(page, "Certificate");
    assert.match(name, /certificate\.json$/);
    assert.equal(JSON.parse(certificate).kind ?? "certify", "certify");
    assert.deepEqual(complaints, []);
    await context.close();
  },

  async "a slow proof is stopped"() {
    const { page, complaints, context } = await opened();
    let hold;
    await page.route("**/api/prove", async route => {
      // The background proof alone waits, so that there is time to stop it.
      if (route.request().postDataJSON().check) await new Promise(resolve => (hold = resolve));
      await route.continue().catch(() => null);
    });
    await page.fill("[aria-label='w, exactly']", "1/20");
    await page.keyboard.press("Enter");
    await page.waitForSelector("#stop:not([hidden])");
    await page.click("#stop");
    await page.waitForSelector("#stop", { state: "hidden" });
    assert.match(await page.textContent("#status"), /Stopped/);
    assert.match(await page.textContent("#checked"), /Not yet proved again/);
    hold?.();
    assert.deepEqual(complaints, []);
    await context.close();
  },

  async "the verdict follows within a moment"() {
    const { page, context } = await opened();
    const times = await page.evaluate(async () => {
      const times = [];
      const field = document.getElementById("parameter-w");
      for (let k = 0; k < 12; k += 1) {
        field.value = `${60 + k}`;
        const start = performance.now();
        field.dispatchEvent(new Event("input"));
        // A microtask later both sections are stale; then the answer comes.
        await new Promise(resolve => {
          const look = () => (document.querySelector("#claims[data-stale]") ? setTimeout(look, 1) : resolve());
          setTimeout(look, 0);
        });
        times.push(performance.now() - start);
      }
      return times.sort((a, b) => a - b);
    });
    console.log(`  four-point: verdict after ${times[6].toFixed(0)} ms (median of 12, largest ${times[11].toFixed(0)} ms)`);
    assert.ok(times[6] < 20_000);
    await context.close();
  },

  async "surfaces, meshes, sets and vertices are drawn"() {
    const { page, complaints, context } = await opened();
    await page.check("input[value=text]");
    for (const label of ["Surface: a bicubic patch in space", "Maps: Sierpiński's triangle", "Vertex: Catmull and Clark with other weights"]) {
      await page.selectOption("#example", { label });
      await settled(page);
      await page.screenshot({ path: join(shots, `${label.split(":")[0].toLowerCase()}.png`) });
    }
    assert.ok(await page.locator("#sheet").isVisible());
    await page.check("input[value=mesh]");
    await settled(page);
    assert.equal(await claim(page, "surface"), "proved");
    await page.screenshot({ path: join(shots, "mesh.png") });
    await page.setInputFiles("#file", { name: "torn.obj", mimeType: "text/plain", buffer: Buffer.from("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n") });
    await page.waitForSelector("#problem:not([hidden])");
    assert.match(await page.textContent("#problem"), /line 4/);
    assert.deepEqual(complaints, []);
    await context.close();
  },

  async "light, dark and a phone"() {
    for (const [name, options] of [
      ["light", {}],
      ["dark", { colorScheme: "dark" }],
      ["phone", { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true, deviceScaleFactor: 1 }],
      ["phone-dark", { viewport: { width: 360, height: 740 }, colorScheme: "dark", isMobile: true, deviceScaleFactor: 1 }],
    ]) {
      const { page, complaints, context } = await opened(options);
      await page.selectOption("#scheme", "schemes:bezier");
      await settled(page);
      assert.equal(await wide(page), false, `${name}: the page is wider than the window`);
      await page.screenshot({ path: join(shots, `${name}.png`), fullPage: name.startsWith("phone") });
      assert.deepEqual(complaints, []);
      await context.close();
    }
  },
};

let failed = false;
for (const [name, step] of Object.entries(steps)) {
  const start = Date.now();
  try {
    await step();
    console.log(`ok ${name} (${Date.now() - start} ms)`);
  } catch (error) {
    failed = true;
    console.error(`FAILED ${name}: ${error.stack}`);
  }
}
await browser.close();
server.kill();
await rm(scratch, { recursive: true, force: true });
process.exit(failed ? 1 : 0);
