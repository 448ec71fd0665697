// A report in a browser: it loads without a complaint and without a request, the slider, the keys
// and the plots move the vehicle to the recorded views, and no name is ever run.
// usage: node page_test.mjs CHROMIUM PAGE RUN...
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { Browser } from "./browser.mjs";

const [chromium, page, ...runs] = process.argv.slice(2);

/** Columns of each view as iterations.csv has them. */
function recorded(run, names) {
  const [head, ...rows] = readFileSync(join(run, "iterations.csv"), "utf8").trim().split("\n");
  const columns = names.map((name) => head.split(",").indexOf(name));
  return rows.map((row) => columns.map((column) => Number(row.split(",")[column])));
}
const recordedViews = (run) => recorded(run, ["x", "y", "z", "yaw"]);

/** How many views a tour still had before it after each of its views; none for other runs. */
function stillPlanned(run) {
  const views = recordedViews(run);
  const file = join(run, "plan.jsonl");
  if (!existsSync(file)) return views.map(() => 0);
  const plans = readFileSync(file, "utf8").trim().split("\n").map((line) => JSON.parse(line));
  return views.map((_, view) => {
    const plan = plans.filter((made) => made.iteration <= view + 1).at(-1);
    let left = plan.tour;
    for (const [x, y, z, yaw] of views.slice(plan.iteration, view + 1)) {
      const at = left.findIndex((pose) => Math.hypot(pose.x_m - x, pose.y_m - y, pose.z_m - z,
        pose.yaw_rad - yaw) < 1e-3);
      left = left.slice(at + 1);
    }
    return left.length;
  });
}

function assertPose(pose, view, what) {
  const turn = Math.abs(pose[3] - view[3]) % (2 * Math.PI);
  // the page computes in double precision, and stores no pose of a view in less
  for (let i = 0; i < 3; ++i) assert.ok(Math.abs(pose[i] - view[i]) < 1e-9, `${what}: ${pose}`);
  assert.ok(Math.min(turn, 2 * Math.PI - turn) < 1e-9, `${what}: ${pose}, not ${view}`);
}

const browser = await Browser.open(chromium, 800, 500);
const complaints = [];
const requests = [];
browser.listen((event, parameters) => {
  if (event === "Runtime.exceptionThrown") complaints.push(JSON.stringify(parameters));
  if (event === "Runtime.consoleAPICalled" && parameters.type === "error") {
    complaints.push(JSON.stringify(parameters.args));
  }
  if (event === "Log.entryAdded" && parameters.entry.level === "error") {
    complaints.push(parameters.entry.text);
  }
  if (event === "Network.requestWillBeSent") requests.push(parameters.request.url);
});
const url = pathToFileURL(resolve(page)).href;
const drawn = () => browser.evaluate(
  "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))");
const pose = (run) => browser.evaluate(`gnbv.pose(${run})`);
const chooseEffort = (effort) => browser.evaluate(
  `[...document.querySelectorAll(".choice button")]
    .find((button) => button.textContent === "${effort}").click()`);
/** Pressed and released where the element has the focus. */
const key = async (name, element) => {
  await browser.evaluate(`${element}.focus()`);
  const code = name === " " ? { code: "Space", text: " ", windowsVirtualKeyCode: 32 }
    : { code: name };
  await browser.call("Input.dispatchKeyEvent", { type: "keyDown", key: name, ...code });
  await browser.call("Input.dispatchKeyEvent", { type: "keyUp", key: name, ...code });
  await drawn();
};
/** Pixels of a picture that are clearly another colour than those of `other`, or than its corner. */
const differentPixels = (picture, other = "") => browser.evaluate(`(async () => {
  const pixels = async (png) => {
    const image = new Image();
    image.src = "data:image/png;base64," + png;
    await image.decode();
    const canvas = new OffscreenCanvas(image.width, image.height).getContext("2d");
    canvas.drawImage(image, 0, 0);
    return canvas.getImageData(0, 0, image.width, image.height).data;
  };
  const a = await pixels("${picture}");
  const b = ${other !== ""} ? await pixels("${other}") : null;
  let count = 0;
  for (let i = 0; i < a.length; i += 4) {
    const away = [0, 1, 2].map((k) => Math.abs(a[i + k] - (b ? b[i + k] : a[k])));
    if (Math.max(...away) > 24) ++count;
  }
  return count;
})()`);
const slider = "document.querySelector('.transport input[type=range]')";

try {
  await browser.call("Page.navigate", { url });
  await browser.until("!!window.gnbv");
  const views = runs.map(recordedViews);

  // the slider moves every vehicle to its recorded view
  for (let n = 1; n <= views[0].length; ++n) {
    await browser.evaluate(
      `${slider}.value = ${n}; ${slider}.dispatchEvent(new Event("input", { bubbles: true }))`);
    await drawn();
    for (const [run, all] of views.entries()) assertPose(await pose(run), all[n - 1], `view ${n}`);
  }

  // so does a key
  await browser.call("Input.dispatchKeyEvent", { type: "keyDown", key: "ArrowLeft", code: "ArrowLeft" });
  await drawn();
  assertPose(await pose(0), views[0].at(-2), "after the left arrow");

  // and a click into a plot
  const place = await browser.evaluate(`(() => {
    const plot = document.querySelector(".u-over");
    plot.scrollIntoView({ block: "center" });
    const box = plot.getBoundingClientRect();
    return [box.left + 0.4 * box.width, box.top + box.height / 2];
  })()`);
  for (const type of ["mousePressed", "mouseReleased"]) {
    await browser.call("Input.dispatchMouseEvent",
      { type, x: place[0], y: place[1], button: "left", clickCount: 1 });
  }
  await drawn();
  const clicked = Number(await browser.evaluate(`${slider}.value`));
  assert.equal(clicked, Math.round(0.4 * 1.02 * views[0].length));
  assertPose(await pose(0), views[0][clicked - 1], "after a click into a plot");

  // in metres and seconds the same moments
  for (const effort of ["Metres", "Seconds"]) {
    await chooseEffort(effort);
    await drawn();
    assert.match(await browser.evaluate("document.querySelector('.readout').textContent"), /View/);
  }

  // before the first view there is a moment of its own, however the mission is measured
  for (const effort of ["Views", "Metres", "Seconds"]) {
    await chooseEffort(effort);
    await key("Home", slider);
    assert.equal(await browser.evaluate("gnbv.views(0)"), 0, effort);
    await key("ArrowRight", slider);
    assert.equal(await browser.evaluate("gnbv.views(0)"), 1, effort);
    assertPose(await pose(0), views[0][0], `the first view in ${effort}`);
  }

  // space belongs to the box that has the focus
  const box = "document.querySelector('.layers input')";
  const wasOn = await browser.evaluate(`${box}.checked`);
  await key(" ", box);
  assert.equal(await browser.evaluate(`${box}.checked`), !wasOn);
  assert.equal(await browser.evaluate("document.querySelector('.play').ariaLabel"), "Play");
  await key(" ", box);

  // playing goes on by itself, rests at a view, and ends where the mission ends
  await chooseEffort("Views");
  await browser.evaluate("gnbv.seek(1)");
  const play = "document.querySelector('.play')";
  // in the page itself: a busy machine would let it play to its end before we could ask
  await browser.evaluate(`new Promise((done) => {
    const look = () => {
      if (Number(${slider}.value) < 2) { requestAnimationFrame(look); return; }
      ${play}.click();
      done(true);
    };
    ${play}.click();
    requestAnimationFrame(look);
  })`);
  const rest = Number(await browser.evaluate(`${slider}.value`));
  await drawn();
  assert.ok(Number.isInteger(rest) && rest < views[0].length, `rests at ${rest}`);
  assertPose(await pose(0), views[0][rest - 1], "after a pause");
  await browser.evaluate(`(() => {
    const speed = document.querySelector(".transport select");
    speed.value = "4";
    speed.dispatchEvent(new Event("change", { bubbles: true }));
  })()`);
  await browser.evaluate(`${play}.click()`);
  await browser.until(`${play}.ariaLabel === "Play"`);
  await drawn();
  assertPose(await pose(0), views[0].at(-1), "when all was played");

  // what is drawn stands out from the background, and changes with the replay
  const clip = await browser.evaluate(`(() => {
    const canvas = document.querySelector(".stage canvas");
    canvas.scrollIntoView({ block: "center" });
    const { x, y, width, height } = canvas.getBoundingClientRect();
    return { x: x + scrollX, y: y + scrollY, width, height };
  })()`);
  const pictureAfter = async (n) => {
    await browser.evaluate(`gnbv.seek(${n})`);
    await drawn();
    return browser.picture(clip);
  };
  const first = await pictureAfter(1);
  const last = await pictureAfter(views[0].length);
  const all = clip.width * clip.height;
  assert.ok(await differentPixels(first) > 0.02 * all, "the 3D view is empty");
  assert.ok(await differentPixels(last, first) > 0.005 * all, "the 3D view does not change");

  // of a tour what it still meant to do, and only where its layer is chosen
  const planned = runs.map(stillPlanned);
  const hasTour = planned.some((counts) => counts.some((count) => count > 0));
  for (let n = 1; n <= views[0].length; ++n) {
    await pictureAfter(n);
    for (const [run, counts] of planned.entries()) {
      assert.equal(await browser.evaluate(`gnbv.plan(${run})`), counts[n - 1], `plan at view ${n}`);
    }
  }
  const togglePlan = () => browser.evaluate(`(() => {
    const label = [...document.querySelectorAll(".layers label")]
      .find((each) => each.textContent === "Plan");
    label?.click();
    return !!label;
  })()`);
  const withPlan = await pictureAfter(2);
  assert.equal(await togglePlan(), hasTour);
  if (hasTour) {
    assert.ok(await differentPixels(await pictureAfter(2), withPlan) > 100, "the plan stays");
    await togglePlan();
  }

  // voxels are as dense as they were at the view, on the way back, too
  await browser.evaluate(`(() => {
    const by = document.querySelector("select[aria-label='Colour of points and voxels']");
    by.value = "density";
    by.dispatchEvent(new Event("change", { bubbles: true }));
  })()`);
  for (const n of [1, views[0].length, 2]) {
    await pictureAfter(n);
    for (const [run, folder] of runs.entries()) {
      const points = recorded(folder, ["cloud_points"])[n - 1][0];
      assert.equal(await browser.evaluate(`gnbv.points(${run})`), points, `points at view ${n}`);
    }
  }

  // a camera that follows shows the vehicle in the same place, and so the world in another
  const toggleFollow = () => browser.evaluate(`[...document.querySelectorAll(".layers label")]
    .find((label) => label.textContent.includes("Follow")).click()`);
  const camera = () => browser.evaluate("gnbv.camera()");
  const beside = async (n) => {
    await pictureAfter(n);
    const [at, from] = [await pose(0), await camera()];
    return from.map((x, i) => x - at[i]);
  };
  await toggleFollow();
  const [near, still] = [await beside(1), await beside(views[0].length)];
  for (let i = 0; i < 3; ++i) assert.ok(Math.abs(near[i] - still[i]) < 1e-6, `${near}, ${still}`);
  await toggleFollow();
  const before = await camera();
  await pictureAfter(1);
  assert.deepEqual(await camera(), before, "nobody is followed any more");

  // at night the page is dark, all of it
  const setTheme = (value) => browser.call("Emulation.setEmulatedMedia",
    { features: [{ name: "prefers-color-scheme", value }] });
  const day = await pictureAfter(2);
  await setTheme("dark");
  const night = await pictureAfter(2);
  assert.ok(await differentPixels(night, day) > 0.5 * all, "the 3D view stays bright");
  await setTheme("light");

  assert.equal(await browser.evaluate("window.hacked"), undefined);
  assert.deepEqual(await browser.evaluate(`document.querySelectorAll(
    "svg:not(.plot-place > svg), svg[onload], svg [onload], #app script").length`), 0);
  assert.ok(await browser.evaluate("document.body.textContent.includes('<svg onload')"),
    "the hostile name is to be read as text");
  assert.deepEqual(complaints, []);
  assert.deepEqual(requests.filter((r) => r !== url && !/^(blob|data):/.test(r)), []);

  // the policy, not good manners, keeps the network out, and foreign scripts
  assert.equal(await browser.evaluate(
    "fetch('https://example.invalid/').then(() => 'sent', () => 'refused')"), "refused");
  assert.ok(complaints.some((text) => text.includes("Content Security Policy")), complaints.join());
  await browser.evaluate(`document.body.append(Object.assign(document.createElement("script"),
    { textContent: "window.hacked = 1" }))`);
  assert.equal(await browser.evaluate("window.hacked"), undefined);

  // without WebGL the rest of the page is there
  complaints.length = 0;
  await browser.call("Page.addScriptToEvaluateOnNewDocument", { source: `
    const { getContext } = HTMLCanvasElement.prototype;
    HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
      return kind.startsWith("webgl") ? null : getContext.call(this, kind, ...rest);
    };` });
  await browser.call("Page.navigate", { url });
  await browser.until("!!window.gnbv");
  assert.match(await browser.evaluate("document.querySelector('.stage').textContent"),
    /3D needs WebGL/);
  assert.ok(await browser.evaluate("document.querySelectorAll('.u-over').length") > 0);
  await browser.evaluate("gnbv.seek(2)");
  assert.equal(await browser.evaluate("gnbv.views(0)"), 2);
  assert.deepEqual(complaints.filter((text) => !text.includes("WebGL")), []);
} finally {
  await browser.close();
}
