// A report in a browser: it loads without a complaint and without a request, the slider, the keys
// and the plots move the vehicle to the recorded views, and no name is ever run.
// usage: node page_test.mjs CHROMIUM PAGE RUN...
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { Browser } from "./browser.mjs";

const [chromium, page, ...runs] = process.argv.slice(2);

/** x, y, z, yaw of each view as iterations.csv has them. */
function recordedViews(run) {
  const [head, ...rows] = readFileSync(join(run, "iterations.csv"), "utf8").trim().split("\n");
  const columns = ["x", "y", "z", "yaw"].map((name) => head.split(",").indexOf(name));
  return rows.map((row) => columns.map((column) => Number(row.split(",")[column])));
}

function assertPose(pose, view, what) {
  const turn = Math.abs(pose[3] - view[3]) % (2 * Math.PI);
  // the page computes in double precision, and stores no pose of a view in less
  for (let i = 0; i < 3; ++i) assert.ok(Math.abs(pose[i] - view[i]) < 1e-9, `${what}: ${pose}`);
  assert.ok(Math.min(turn, 2 * Math.PI - turn) < 1e-9, `${what}: ${pose}, not ${view}`);
}

const browser = await Browser.open(chromium, 1000, 700);
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
  assert.equal(clicked, Math.round(0.4 * views[0].length));
  assertPose(await pose(0), views[0][clicked - 1], "after a click into a plot");

  // in metres and seconds the same moments
  for (const effort of ["Metres", "Seconds"]) {
    await browser.evaluate(`[...document.querySelectorAll(".choice button")]
      .find((button) => button.textContent === "${effort}").click()`);
    await drawn();
    assert.match(await browser.evaluate("document.querySelector('.readout').textContent"), /View/);
  }

  // something is drawn: not every pixel of the 3D view is the same
  const { data } = await browser.call("Page.captureScreenshot", { format: "png" });
  assert.ok(data.length > 50_000, `a screenshot of ${data.length} bytes`);

  assert.equal(await browser.evaluate("window.hacked"), undefined);
  assert.deepEqual(await browser.evaluate("[...document.querySelectorAll('svg, #app script')].length"), 0);
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
} finally {
  await browser.close();
}
