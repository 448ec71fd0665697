// A page that is served while its mission flies: it asks for more, and shows it when there is some.

const kAsk_ms = 1500;

/**
 * Reloads the page when there is more of the run than `shown` (the number of its views, and
 * "finished" behind a blank when it is), after `leave`, which keeps what the reader has set. Says in
 * `place` how it stands.
 */
export function followRun(shown: string, leave: () => void, place: HTMLElement) {
  place.textContent = "live";
  setInterval(async () => {
    try {
      const answer = await fetch("views", { cache: "no-store" });
      const now = (await answer.text()).trim();
      place.textContent = "live";
      if (!answer.ok || now === shown || document.visibilityState !== "visible") return;
      leave();
      location.reload();
    } catch {
      place.textContent = "no longer live: the run has ended, or its terminal was closed";
    }
  }, kAsk_ms);
}
