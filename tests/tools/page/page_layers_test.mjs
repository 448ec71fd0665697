// A report in a browser says and shows what the run directory holds: layers, legend, decisions,
// plots; in a link, as files, on paper and on a phone.
// usage: node page_layers_test.mjs CHROMIUM PAGE RUN... [--only CHECK...]
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { Page, csv, different, jsonLines, viewsOf } from "./page_driver.mjs";

const [chromium, file, ...rest] = process.argv.slice(2);
const runs = rest.slice(0, rest.concat("--only").indexOf("--only"));
const only = rest.slice(runs.length + 1);
const isAlone = runs.length === 1;
const page = await Page.open(chromium, file, 1200, 800);
const curves = runs.map((run) =>
  csv(run, "coverage.csv").map((row) => Number(row["coverage_0.05"])));
const views = runs.map(viewsOf);
const last = views[0].length;
const viewAt = (run, n) => Math.min(n, views[run].length) - 1;

/** A reason of rejection as pictures and pages name it. */
const words = (reason) => ({ recently_visited: "visited", no_fly: "no-fly box",
  cluster_outside_fov: "cluster outside view", beyond_gimbal: "beyond the gimbal" })[reason]
  ?? reason.replaceAll("_", " ");

/** The values beside the names of a plot's lines. */
const valuesOf = async (plot) =>
  (await page.textOf(`.plot:nth-child(${plot}) .values b`)).split("\n");

async function gistIsLikeTheWhole() {
  const { identifier } = await page.browser.call("Page.addScriptToEvaluateOnNewDocument", { source: `
    const later = setTimeout.bind(window);
    window.held = [];
    window.setTimeout = (call, ms, ...rest) =>
      ms >= 600 && window.held ? window.held.push(call) : later(call, ms, ...rest);` });
  for (const layers of ["cloud,structure,path", "found,missed,structure"]) {
    await page.go(`#layers=${layers}`);
    const gist = await page.cells();
    assert.equal((await page.is("gnbv.stage.detail.drawnSoFar")).whole, 0);
    await page.is("[held.splice(0), held = null][0].forEach((call) => call())");
    await page.until("gnbv.stage.detail.drawnSoFar.whole > 0");
    const whole = await page.cells();
    const drawn = different(whole);
    assert.ok(drawn > 0.01 * whole.length, `${drawn} cells of ${whole.length}: ${layers}`);
    const other = different(whole, gist, 48);
    assert.ok(other < 0.1 * drawn, `${other} of ${drawn} cells differ: ${layers}`);
  }
  await page.browser.call("Page.removeScriptToEvaluateOnNewDocument", { identifier });
}

/** Found is what coverage.csv says, at every view and on the way back. */
async function foundIsCoverage() {
  await page.go("#layers=found,missed");
  for (const n of [...curves[0].keys(), 1]) {
    await page.seek(n);
    for (const [run, curve] of curves.entries()) {
      const { found, missed, onlyOther } = await page.is(`gnbv.found(${run})`);
      const share = found / (found + missed + onlyOther);
      assert.ok(Math.abs(share - curve[viewAt(run, n) + 1]) < 1e-6, `view ${n}: ${share}`);
      assert.ok(!isAlone || onlyOther === 0);
    }
  }
  assert.equal(/found by another run/.test(await page.textOf(".legend")), !isAlone);
  await page.until("document.querySelectorAll('.regions button').length > 0");
  const before = await page.is("gnbv.camera()");
  await page.is("document.querySelector('.regions button').click()");
  await page.drawn();
  assert.notDeepEqual(await page.is("gnbv.camera()"), before, "a missed region is looked at");
}

/** Each decision with all its candidates, what became of them, and whom it was for. */
async function decisionsAreTold() {
  const hasFrontiers = runs.some((run) =>
    readFileSync(join(run, "beliefs.jsonl"), "utf8").includes("frontier"));
  assert.equal((await page.textOf(".layers label")).includes("Frontiers"), hasFrontiers);
  await page.go("#layers=candidates,unknown,frontiers");
  const range_m = await page.is("Math.max(...gnbv.data.runs[0].cameras.map((c) => c.range_m))");
  let [voxels, bursts] = [0, 0];
  for (let n = 1; n <= last; ++n) {
    await page.seek(n);
    const [legend, why] = [await page.textOf(".legend"), await page.textOf(".why")];
    for (const [run, folder] of runs.entries()) {
      const view = viewAt(run, n);
      // any view of a burst has the decision of its first
      const number = Number(csv(folder, "iterations.csv")[view].plan_view ?? 1);
      const first = view + 1 - number;
      const all = jsonLines(folder, "candidates.jsonl").filter((c) => c.iteration === first);
      assert.equal(await page.is(`gnbv.candidates(${run})`), all.length, `view ${n}`);
      const kept = all.filter((c) => c.chosen && c.covers !== undefined);
      if (kept.length > 0) {
        const burst = `${number} of ${kept.length} of the burst planned at view ${first + 1}: `;
        assert.ok(why.includes(`View ${burst}`), why);
        const row = await page.textOf(".why .ours > *"); // a cell a line
        assert.ok(row.includes(`${number}, this view\n${kept[number - 1].covers}`), row);
        bursts += 1;
      }
      for (const { rejected } of all) if (rejected) assert.ok(why.includes(words(rejected)), why);
      const counts = [];
      for (const kind of ["unknown", "frontier", "looked_at"]) {
        counts.push(await page.is(`gnbv.data.runs[${run}].beliefs.${kind}?.counts[${first}] ?? 0`));
        const drawn = await page.is(`gnbv.believed(${run}, "${kind}")`);
        assert.equal(drawn, counts.at(-1), `view ${n}: ${kind}`);
        voxels += drawn;
      }
      if (!isAlone || all.length === 0) continue;
      // counts add up to all of them, of the sampler that chose in the very words of the replay
      const numbers = [...legend.matchAll(/: ([\d,]+)/g)].map(([, n]) => Number(n.replaceAll(",", "")));
      const sum = (values) => values.reduce((a, b) => a + b, 0);
      assert.equal(sum(numbers) - sum(counts), all.length, legend);
      const told = (await page.textOf(".readout")).match(/[\d,]+ of [\d,]+ \w+ candidates valid/)[0];
      assert.ok(why.includes(told), why);
    }
    // rays end within the camera's range; reasons are explained
    const ends = await page.is("gnbv.rays(0)");
    for (let i = 0; i < ends.length; i += 3) {
      const away = Math.hypot(...[0, 1, 2].map((k) => ends[i + k] - views[0][n - 1][k]));
      assert.ok(away < range_m + 1, `${away} m from view ${n}`);
    }
    assert.equal(await page.is(`[...document.querySelectorAll(".why p span")]
      .filter((reason) => reason.title.length < 20).length`), 0);
  }
  assert.ok(voxels > 50, `${voxels}`);
  assert.ok(bursts > 0 || !runs.includes("bursts"));
}

/** The pyramid of a view stands where the view is; a view tells what it saw, a point who saw it. */
async function pointingTells() {
  for (const [run, all] of views.entries()) {
    for (const [view, place] of all.entries()) {
      const ends = await page.is(`gnbv.frustum(${run}, ${view})`);
      assert.ok(ends.length > 0);
      for (let i = 0; i < ends.length; i += 3) {
        assert.ok(Math.hypot(...[0, 1, 2].map((k) => ends[i + k] - place[k])) < 2);
      }
    }
  }
  const [x, y, z] = views[0][0];
  await page.go(`#at=${last}&runs=0&layers=frusta&camera=${x},${y - 1},${z},${x},${y},${z}`);
  await page.press("Enter", ".stage canvas");
  assert.match(await page.textOf(".picked"), /^View \d+, at/);
  assert.ok(await page.visible(".picked img") > 0);
  const { tried, sawIt } = await page.is(`(() => {
    const all = Array.from({ length: 100000 }, (_, i) => gnbv.point(0, 7 * i))
      .filter((point) => point && point[3] >= 0);
    return { tried: all.length,
      sawIt: all.filter((p) => gnbv.seenBy(0, p.slice(0, 3)).includes(p[3])).length };
  })()`);
  assert.ok(tried > 3 && sawIt >= 0.85 * tried, `${sawIt} of ${tried}`);
}

/** The line of the surface has the truth to its left alone and the surface to its right alone. */
async function lineParts() {
  await page.go("#layers=structure");
  await page.until("gnbv.stage.detail.drawnSoFar.whole > 0");
  const alone = await page.cells();
  await page.go("#layers=structure,surface,cloud");
  assert.doesNotMatch(await page.textOf(".legend"), /points:/);
  const at = async (share) => {
    const { whole } = await page.is("gnbv.stage.detail.drawnSoFar");
    await page.set(".swipe input", share);
    await page.until(`gnbv.stage.detail.drawnSoFar.whole > ${whole}`);
    return page.cells();
  };
  const [surface, half, truth] = [await at(0), await at(0.5), await at(1)];
  const columns = await page.is(
    "Math.floor(document.querySelector('.stage canvas').clientWidth / 8)");
  const side = (cells, isAsked) => cells.filter((_, i) => i > 9 * columns // below the labels
    && isAsked(i % columns / columns));
  const [left, right] = [(x) => x < 0.47, (x) => x > 0.53];
  const differ = (a, b, isAsked) => different(side(a, isAsked), side(b, isAsked));
  assert.equal(differ(truth, alone, () => true), 0);
  assert.equal(differ(half, truth, left), 0);
  assert.equal(differ(half, surface, right), 0);
  assert.ok(differ(half, surface, left) > 5 && differ(half, truth, right) > 5);
}

/** Legends tell of what is there, and what colours stand for at both ends and in the middle. */
async function legendsTell() {
  await page.go("#layers=cloud,voxels&colour=real");
  assert.match(await page.textOf(".legend"), /points: camera colours.*voxels: height/);
  await page.go("#layers=cloud,voxels&colour=density");
  assert.match(await page.textOf(".legend"), /points, voxels: density.* or more points/);
  for (const ends of await page.is(`[...document.querySelectorAll(".scale-ends")]
    .map((under) => [...under.children].map((end) => end.textContent))`)) {
    assert.ok(ends.length === 3 && ends.every((end) => end !== ""), `${ends}`);
  }
  // before the first view there is a coverage, the profile's, and no density
  await page.go();
  const ofViews = /path, views: first|points of this view|what the cameras see/;
  await page.seek(0);
  assert.ok((await valuesOf(1)).every((value) => value !== "–"));
  assert.ok((await valuesOf(3)).every((value) => value === "–"));
  assert.doesNotMatch(await page.textOf(".legend"), ofViews);
  assert.match(await page.textOf(".legend"), /profile flight/);
  assert.ok((await page.textOf(".strip figcaption")).split("\n")
    .every((text) => text.includes("next: view 1")));
  await page.seek(1);
  assert.match(await page.textOf(".legend"), ofViews);
  assert.ok((await valuesOf(3)).every((value) => value !== "–"));
  // "Fit" has what the layers show in the picture: it goes back for what lies farther out
  const distance = async (layers) => {
    await page.go(`#layers=${layers}&at=2`);
    await page.click("Fit");
    return Math.hypot(...await page.is("gnbv.camera()"));
  };
  assert.ok(await distance("structure,profile") > await distance("structure"));
}

/** Each run is told apart in every plot; seeds of one configuration may be their mean. */
async function plotsTellRunsApart() {
  await page.go();
  for (const lines of await page.is(`[...document.querySelectorAll(".plot-place svg")].map((svg) =>
    [...svg.querySelectorAll("path[stroke-dasharray]")].map((path) =>
      ["stroke-dasharray", "stroke", "stroke-width"].map((name) => path.getAttribute(name))))`)) {
    const looks = lines.map(([dashes, colour]) => dashes + colour);
    assert.ok(new Set(looks).size >= Math.min(looks.length, isAlone ? 1 : 2), `${looks}`);
    for (const [dashes, , width] of lines) {  // those of look_of_slot() and of a level, in line widths
      const on = Number.parseFloat(dashes) / width;
      assert.ok(dashes === "none" || [5, 1.8, 0.8, 4].some((its) => Math.abs(on / its - 1) < 0.1),
        `${dashes} of ${width}`);
    }
  }
  const atFrontiers = runs.filter((run) =>
    readFileSync(join(run, "iterations.csv"), "utf8").includes(",fvs,"));
  assert.equal(await page.visible(".lane"), isAlone ? 0 : atFrontiers.length);
  const yamls = runs.map((run) => readFileSync(join(run, "scenario.yaml"), "utf8"));
  const hasSeeds = new Set(yamls).size > 1
    && new Set(yamls.map((yaml) => yaml.replace(/^seed:.*$/m, ""))).size === 1;
  const seeds = "select[aria-label='Runs of several seeds']";
  assert.equal(await page.visible(seeds), Number(hasSeeds));
  if (hasSeeds) {
    await page.set(seeds, "means");
    const mean = curves.reduce((sum, curve) => sum + 100 * curve.at(-1), 0) / curves.length;
    await page.seek(Math.max(...views.map((all) => all.length)));
    assert.ok((await valuesOf(1))[0].includes(mean.toPrecision(3)), `${mean}`);
  }
  // the last view is not on the edge of a plot
  assert.ok(await page.is(`[...document.querySelectorAll(".plot-place")].every((place) =>
    place.getBoundingClientRect().right
      - place.querySelector(".now").getBoundingClientRect().right > 17)`));
}

/** A link shows what its sender saw, also nothing; a link that makes no sense shows the page. */
async function linksShow() {
  for (const [by, name] of [["metres", "Metres"], ["seconds", "Seconds"],
    ["metres_with_profile", "From take-off: m"], ["seconds_with_profile", "s"],
    ["wh_with_profile", "Wh"], ["views", "Views"]]) {
    await page.go(`#by=${by}&at=1`);
    assert.equal(await page.textOf(".choice [aria-pressed=true]"), name);
    if (!by.includes("_")) continue;
    // the profile is no view, and what it covered is told while no view is
    assert.match(await page.textOf(".readout"), /Before the first view/);
    assert.ok((await valuesOf(1)).some((value) => value !== "–"), by);
    await page.go(`#by=${by}&at=1e9`);
    assert.match(await page.textOf(".readout"), /View \d+ of \d+/);
  }
  await page.go("#layers=missed");
  for (const key of ["a", "w", "+", "l", "i"]) {
    const from = await page.is("gnbv.camera()");
    await page.press(key, ".stage canvas");
    assert.notDeepEqual(await page.is("gnbv.camera()"), from, key);
  }
  await page.seek(2);
  await page.press("d", ".stage canvas");
  await page.until("location.hash.includes('at=2') && location.hash.includes('missed')");
  await new Promise((done) => setTimeout(done, 600));
  const [seen, hash] = await page.is("[gnbv.camera(), location.hash]");
  await page.go(hash);
  assert.equal(await page.is("gnbv.views(0)"), 2);
  (await page.is("gnbv.camera()")).forEach((c, i) => assert.ok(Math.abs(c - seen[i]) < 2e-3));
  const boxes = ".layers .toggle input:checked";
  await page.click("Missed");
  await page.is("document.querySelectorAll('.runs input').forEach((box) => box.click())");
  await page.until(`/layers=&.*runs=${isAlone ? "0" : ""}$/.test(location.hash)`);
  await page.go(await page.is("location.hash"));
  assert.equal(await page.visible(boxes), 0, "a link in which nothing is shown shows nothing");
  if (!isAlone) assert.equal(await page.visible(".runs input:checked"), 0);
  await page.go("#at=x&camera=1,2&runs=99&layers=<svg>&by=no");
  assert.equal(await page.visible(".pane"), Math.min(4, runs.length));
}

/** Pictures as files. */
async function filesAreSaved() {
  await page.browser.call("Page.setDownloadBehavior", { behavior: "deny" });
  await page.go();
  const saved = (button) => page.is(`new Promise((done) => {
    const make = URL.createObjectURL;
    URL.createObjectURL = (blob) => {
      URL.createObjectURL = make;
      blob.text().then((text) => done([blob.type, blob.size, text.slice(0, 100000)]));
      return make.call(URL, blob);
    };
    [...document.querySelectorAll("button")].find((b) => b.textContent === "${button}").click();
  })`);
  const [type, size] = await saved("Save PNG");
  assert.ok(type === "image/png" && size > 5000, `${type} of ${size} bytes`);
  const [, , svg] = await saved("SVG");
  assert.deepEqual(await page.is(`(() => {
    const svg = new DOMParser().parseFromString(${JSON.stringify(svg)}, "image/svg+xml");
    return [svg.querySelectorAll("parsererror, script").length,
      svg.querySelectorAll("path[stroke-dasharray]").length > 0];
  })()`), [0, true]);
}

/** What can be used has a name, is reached by Tab and large enough; nothing reaches beyond. */
async function fitsAnyPaper() {
  const poor = await page.is(`[...document.querySelectorAll(
      "button, select, summary, input, canvas[tabindex], .toggle")]
    .filter((e) => e.checkVisibility()).flatMap((e) => {
      const { width, height } = (e.closest("label") ?? e).getBoundingClientRect();
      const name = e.ariaLabel || e.textContent || e.closest("label")?.textContent;
      const isSmall = width < 24 || height < 24;
      return !name || isSmall || (e.tabIndex < 0 && !e.matches(".toggle"))
        ? [e.outerHTML.slice(0, 80) + " " + width + "x" + height] : [];
    })`);
  assert.deepEqual(poor, []);
  const topsOf = (selector) => page.is(`[...document.querySelectorAll("${selector}")]
    .map((e) => Math.round(e.getBoundingClientRect().top))`);
  await page.shape(700, 900);
  const tops = await topsOf(".tile");
  assert.equal(tops.filter((top) => top === tops[0]).length, Math.ceil(tops.length / 2));
  assert.equal(new Set(await topsOf(".tools button")).size, 1);
  assert.equal(new Set(await topsOf(".pane")).size, runs.length);
  // A4 is 186 mm between its margins: plots are vectors, nothing is there to click
  await page.shape(703, 1032, "print");
  assert.ok(await page.is("document.documentElement.scrollWidth") <= 703);
  assert.ok(await page.visible(".plot-place svg") >= 3);
  assert.equal(await page.visible("button:not(.picture), select, input"), 0);
  assert.equal((await page.textOf(".plot:first-child :is(.plot-title, .plot-choice)"))
    .replaceAll("\n", ""), "Coverage, 0.05 m");
  await page.shape(390, 844);
  assert.ok(await page.is("document.documentElement.scrollWidth") <= 390);
  const columns = await page.is(`[...document.querySelectorAll(".layers .toggle")]
    .map((e) => Math.round(e.getBoundingClientRect().left))`);
  assert.equal(new Set(columns).size, 3, columns.join(" "));
  await page.shape(1200, 800);
}

/** Who prints at once, before the browser asks for any picture, has one, of paper's shape. */
async function printsAtOnce() {
  const { identifier } = await page.browser.call("Page.addScriptToEvaluateOnNewDocument",
    { source: "window.requestAnimationFrame = () => 0;" });
  await page.browser.call("Page.navigate", { url: "about:blank" });
  await page.browser.call("Page.navigate", { url: page.url });
  await page.until("!!window.gnbv");
  assert.equal((await page.is("gnbv.stage.detail.drawnSoFar")).gist, 1);
  const [ratio, pixels, colours] = await page.is(`(() => {
    dispatchEvent(new Event("beforeprint"));
    const canvas = document.querySelector(".stage canvas");
    const stage = document.querySelector(".stage.printed");
    const context = new OffscreenCanvas(100, 60).getContext("2d");
    context.drawImage(canvas, 0, 0, 100, 60);
    const { data } = context.getImageData(0, 0, 100, 60);
    const seen = new Set();
    for (let i = 0; i < data.length; i += 4) seen.add(data.slice(i, i + 3).join());
    return [canvas.width / canvas.height * stage.clientHeight / stage.clientWidth, canvas.width,
      seen.size];
  })()`);
  assert.ok(Math.abs(ratio - 1) < 0.02 && pixels > 1300, `${ratio}, ${pixels} px`);
  assert.ok(colours > 50, `${colours} colours`);
  await page.browser.call("Page.removeScriptToEvaluateOnNewDocument", { identifier });
}

/** To and fro by 2 m along x, at 0.37 m/s. */
async function bodiesMove() {
  await page.go("#layers=structure,path");
  for (const [i, { time_s }] of csv(runs[0], "iterations.csv").entries()) {
    await page.seek(i + 1);
    const along = 0.37 * Number(time_s) % 4;
    const [x, y, z] = await page.is("gnbv.scenes[0].movers[0].object.position.toArray()");
    assert.ok(Math.abs(x - Math.min(along, 4 - along)) < 0.01 && y === 0 && z === 0, `${x}`);
  }
}

const hasLine = isAlone && existsSync(join(runs[0], "surface"));
const checks = [gistIsLikeTheWhole, foundIsCoverage, decisionsAreTold, pointingTells,
  ...hasLine ? [lineParts] : [], ...only.includes("bodiesMove") ? [bodiesMove] : [], legendsTell, plotsTellRunsApart, linksShow, filesAreSaved,
  fitsAnyPaper, printsAtOnce];
const asked = checks.filter(({ name }) => only.length === 0 || only.includes(name));
assert.ok(asked.length >= Math.max(1, only.length), `no such check: ${only}`);
try {
  await page.go();
  for (const check of asked) await check();
  assert.deepEqual(page.complaints, []);
  assert.equal(await page.is("window.hacked"), undefined);
} finally {
  await page.close();
}
