// Laws of --live: browsers change nothing of the mission, the page grows with it, and the server
// answers only what it should.
// usage: in_browser.sh node live_test.mjs GNBV
import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { copyFileSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { request } from "node:http";
import { connect } from "node:net";
import { Browser } from "../page/browser.mjs";

const gnbv = process.argv[2];
const kViews = 40;
const fly = (out, ...more) => ["run", "smoke", "--seed", "1", "--threads", "1", "--out", out,
  "--set", `planner.termination.max_iterations=${kViews}`, ...more];
const hashOf = (run) => JSON.parse(readFileSync(`${run}/summary.json`, "utf8")).result_sha256;
const sleep = (ms) => new Promise((done) => setTimeout(done, ms));

/** Status, headers and body of what is asked of the server. */
const ask = (url, options = {}) => new Promise((done, fail) => {
  const asked = request(url, { agent: false, ...options }, (answer) => {
    let body = "";
    answer.on("data", (chunk) => { body += chunk; });
    answer.on("end", () => done({ status: answer.statusCode, headers: answer.headers, body }));
  });
  asked.on("error", fail);
  asked.end(options.body);
});

/** Starts the program and waits for the address it says. */
async function start(args) {
  const child = spawn(gnbv, args, { stdio: ["ignore", "pipe", "pipe"] });
  let said = "";
  const ended = new Promise((done) => child.once("exit", (code) => done(code)));
  const url = await new Promise((done, fail) => {
    const look = (chunk) => {
      said += chunk;
      const found = said.match(/http:\/\/127\.0\.0\.1:\d+\//);
      if (found) done(found[0]);
    };
    child.stdout.on("data", look);
    child.stderr.on("data", look);
    ended.then(() => fail(new Error(`no address: ${said}`)));
  });
  return { child, url, ended };
}

/** Connections that ask and never take, that trickle, and that talk nonsense. */
function pester(url) {
  const port = Number(new URL(url).port);
  const all = ["GET / HTTP/1.1\r\nHost: localhost\r\n\r\n".repeat(50), "GET / HTTP/1.1\r\nX: ",
    "\0\xff".repeat(5000), `POST / HTTP/1.1\r\nHost: 127.0.0.1:${port}\r\n`
    + "Content-Length: 99999999999\r\n\r\n"].flatMap((words) => Array.from({ length: 10 }, () => {
    const socket = connect(port, "127.0.0.1", () => socket.write(words));
    socket.on("error", () => {});
    socket.pause();
    const trickle = setInterval(() => socket.writable && socket.write("a"), 200);
    socket.on("close", () => clearInterval(trickle));
    return socket;
  }));
  return () => all.forEach((socket) => socket.destroy());
}

// ---- a mission among browsers ends as one alone
assert.equal(spawnSync(gnbv, fly("alone", "--quiet")).status, 0);
const flight = await start(fly("watched", "--live", "0"));
const stop = pester(flight.url);
assert.equal(await flight.ended, 0);
stop();
assert.equal(hashOf("watched"), hashOf("alone"));
assert.deepEqual(readdirSync("watched").sort(), readdirSync("alone").sort());
await assert.rejects(ask(flight.url), "the server is gone with the mission");

// ---- a port that is taken is said before anything is flown
const server = await start(["report", "alone", "--live", "0"]);
const { port } = new URL(server.url);
const taken = spawnSync(gnbv, fly("never", "--live", port), { encoding: "utf8" });
assert.equal(taken.status, 2, taken.stderr);
assert.match(taken.stderr, new RegExp(`--live ${port}`));
assert.throws(() => readdirSync("never"));

// ---- what the server answers, and how
while ((await ask(`${server.url}views`)).body !== `${kViews} finished\n`) await sleep(100);
const page = await ask(server.url);
assert.equal(page.status, 200);
assert.match(page.headers["content-type"], /^text\/html/);
const policy = page.headers["content-security-policy"];
assert.match(policy, /default-src 'none'/);
assert.match(policy, /frame-ancestors 'none'/);
assert.ok(!policy.includes("unsafe"), policy);
assert.ok(page.body.includes("<canvas") || page.body.includes("id=\"data\""));
assert.equal(page.headers["x-content-type-options"], "nosniff");
assert.equal(page.headers["referrer-policy"], "no-referrer");
assert.equal(page.headers["cache-control"], "no-store");
assert.equal(page.headers["cross-origin-resource-policy"], "same-origin");
assert.equal(page.headers["access-control-allow-origin"], undefined);
assert.equal((await ask(server.url, { headers: { host: "evil.example" } })).status, 403);
assert.equal((await ask(server.url, { headers: { host: `evil.example:${port}` } })).status, 403);
for (const method of ["POST", "PUT", "DELETE", "OPTIONS"]) {
  const { status, body } = await ask(server.url, { method });
  assert.equal(status, 405, method);
  assert.ok(body.length < 100);
}
for (const path of ["scenario.yaml", "../../etc/passwd", "%2e%2e/x", "views/../x"]) {
  assert.equal((await ask(server.url + path)).status, 404, path);
}
const stopTrickling = pester(server.url);
await sleep(1000);
server.child.kill("SIGTERM");
assert.equal(await Promise.race([server.ended, sleep(20000)]), 0, "nobody holds its end up");
stopTrickling();

// ---- in a browser the page grows with the run, and keeps what its reader has set
const rows = readFileSync("alone/iterations.csv", "utf8").trim().split("\n");
const grow = (views) => writeFileSync("growing/iterations.csv.part",
  `${rows.slice(0, views + 1).join("\n")}\n`);
mkdirSync("growing");
copyFileSync("alone/scenario.yaml", "growing/scenario.yaml");
grow(3);
const growing = await start(["report", "growing", "--live", "0"]);
const browser = await Browser.open(process.env.CHROMIUM, 800, 600);
try {
  const complaints = [];
  browser.listen((event, parameters) => {
    if (event === "Runtime.exceptionThrown") complaints.push(JSON.stringify(parameters));
    if (event === "Log.entryAdded" && parameters.entry.level === "error") {
      complaints.push(parameters.entry.text + parameters.entry.url);
    }
  });
  const has = (views) => browser.until(`window.gnbv?.scenes[0].flight.n === ${views}`);
  while ((await ask(`${growing.url}views`)).body.trim() !== "3") await sleep(100);
  await browser.call("Page.navigate", { url: growing.url });
  await has(3);
  const frusta = `[...document.querySelectorAll(".layers label")]
    .find((label) => label.textContent === "All views").querySelector("input")`;
  await browser.evaluate(`${frusta}.click()`);
  grow(7);
  await has(7);
  assert.equal(await browser.evaluate(`${frusta}.checked`), true);
  assert.match(await browser.evaluate("document.querySelector('.live').textContent"), /^live/);
  assert.deepEqual(complaints.filter((text) => !text.includes("favicon")), []);
  growing.child.kill("SIGTERM");
  assert.equal(await growing.ended, 0);
  await browser.until("document.querySelector('.live').textContent.includes('no longer')");
} finally {
  await browser.close();
  growing.child.kill("SIGKILL");
}
