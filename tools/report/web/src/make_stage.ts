// The 3D view, or what stands in its place where the browser cannot draw it.
import type { Clock } from "./clock";
import type { View3d } from "./controls";
import { NoStage } from "./no_stage";
import type { RunScene } from "./run_scene";
import { Stage } from "./stage";

export function makeStage(scenes: RunScene[], clock: Clock, name: string,
    goTo: (view: number) => void): View3d {
  try {
    return new Stage(scenes, clock, name, goTo);
  } catch (error) {
    console.warn(error);
    return new NoStage();
  }
}
