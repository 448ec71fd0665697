// The page of `gnbv report`: reads what the program wrote into it, and puts the parts together.
import type { Sphere, Vector3 } from "three";
import { Clock } from "./clock";
import { cssOnPage, setLooks } from "./colours";
import { firstChoice, listenToKeys, makeLayerBar, makeTransport } from "./controls";
import { fileName, make, ofRun } from "./dom";
import { Flight } from "./flight";
import { legendItems } from "./legend";
import { followRun } from "./live";
import { readPage } from "./page";
import * as panels from "./panels";
import { hashOf, readState } from "./permalink";
import { Plots } from "./plots";
import { viewsThatSaw } from "./pointing";
import { RunScene } from "./run_scene";
import { Stage } from "./stage";
import { makeMissedList } from "./true_surface";

function build() {
  const page = readPage();
  setLooks(page.scene);
  page.runs.forEach(({ colour }, i) =>
    document.documentElement.style.setProperty(`--run-${i}`, cssOnPage(colour)));
  const clock = new Clock();
  const flights = page.runs.map((run, i) => new Flight(run, i, clock));
  const scenes = flights.map((flight) => new RunScene(flight, page));
  const stage = Stage.make(scenes, clock, fileName(page.title));
  const isAlone = flights.length === 1;
  const plots = new Plots(page.plots, clock);
  const strip = new panels.FrameStrip();
  const words = make("p", { class: "readout", "aria-live": "off" });
  const key = make("p", { class: "legend", "aria-label": "Legend" });
  const why = make("div", { class: "why" });
  const missed = make("div", { class: "missed-list" });
  const state = readState(location.hash);
  const chosen = firstChoice(scenes, state);
  const shown = new Set(state.runs?.every((run) => run in flights) ? state.runs
    : [...flights.keys()].slice(0, 4)); // more panes are too small
  const shownScenes = () => scenes.filter(({ flight }) => shown.has(flight.index));
  const shownFlights = () => shownScenes().map(({ flight }) => flight);

  let timer = 0;
  const writeState = () => history.replaceState(null, "", hashOf({ effort: clock.effort,
    // a live page that is at its end stays there when the end moves on
    at: page.is_live && clock.at >= clock.last() ? Infinity : clock.at,
    camera: stage?.cameraState() ?? [], colour: chosen.colour, runs: [...shown],
    layers: Object.keys(chosen.layers).filter((name) => chosen.layers[name]) }));
  /** Some moments after the last change. */
  const remember = () => {
    clearTimeout(timer);
    timer = window.setTimeout(writeState, 400);
  };

  const explain = () => {
    for (const scene of shownScenes()) scene.decide(); // the legend counts what was decided
    key.replaceChildren(...legendItems(shownScenes(), chosen.layers, chosen.colour));
    why.replaceChildren(...!chosen.layers.candidates ? []
      : shownScenes().filter(({ candidates }) => candidates).map(({ candidates, flight }) =>
        make("div", {}, make("h3", {}, isAlone ? "Why this view"
          : `Why this view: ${flight.data.label}`), candidates!.table())));
  };
  const changed = () => {
    explain();
    remember();
  };
  clock.onChange(() => {
    words.replaceChildren(...shownFlights().map((flight) => make("span", {},
      isAlone ? null : ofRun("dot", flight.index), panels.readout(flight))));
    strip.show(shownFlights());
    changed();
  });
  const setShown = () => {
    stage?.setShown(shownScenes());
    changed();
    plots.build({ hidden: page.runs.filter((_, i) => !shown.has(i)).map(({ label }) => label) });
    clock.setFlights(shownFlights());
  };
  const layerBar = stage && makeLayerBar(scenes, stage, chosen, changed);
  stage?.setLayers(chosen.layers);
  stage?.colour(chosen.colour);
  stage?.onChange(remember);

  document.getElementById("app")!.replaceChildren(
    panels.makeHeader(page),
    make("main", {},
      isAlone ? panels.makeTiles(page.runs[0])
        : panels.makeRunTable(page.runs, shown, setShown),
      make("div", { class: isAlone ? "board" : "board several" },
        make("section", { class: "mission", "aria-label": "The mission in 3D" },
          make("div", { class: "card view" }, layerBar, stage?.element
            ?? make("p", { class: "nothing" },
              "3D needs WebGL, which this browser or its settings do not offer."),
          stage && key, makeTransport(clock, words), words, why),
          strip.element),
        make("div", { class: "side" }, plots.element, missed)),
      page.tables.length > 0 ? make("section", {}, make("h2", {},
        page.tables.some((table) => table.rows.some((row) => row.includes("paper")))
          ? "Beside the paper" : "In one table"),
        ...page.tables.map(panels.makeTable)) : null,
      panels.makeMissing(page.runs),
      panels.makeConfiguration(page.runs)),
    panels.makeFooter(page));
  const showMissed = (scene: RunScene, { center, radius }: Sphere, back: Vector3) => {
    const box = layerBar!.querySelector<HTMLInputElement>("[name=missed]")!;
    if (!box.checked) box.click();
    stage!.lookAt(scene, center, back, radius);
    stage!.element.scrollIntoView({ block: "nearest" });
  };
  // after the first picture: it takes its time
  setTimeout(() => missed.append(stage && makeMissedList(scenes, showMissed) || ""), 300);
  setShown();
  clock.setEffort(state.effort ?? "views");
  clock.moveTo(state.at ?? clock.last());
  if (state.camera) stage?.setCamera(state.camera);
  stage?.drawNow();
  if (page.is_live) {
    const end = page.runs[0].figures ? " finished" : "";
    followRun(`${flights[0].count}${end}`, writeState,
      document.querySelector("header")!.appendChild(make("p", { class: "live", role: "status" })));
  }
  listenToKeys(clock);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => stage?.invalidate());
  // for scripts and tests
  Object.assign(window, { gnbv: { data: page, clock, scenes, stage, viewsThatSaw } });
}

build();
