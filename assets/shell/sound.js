// Plays pieces of sound one after the other without a seam, and fades where there is nothing more to play.

// Seconds between the arrival of the first piece and its sound: the next one must come in that time.
const AHEAD = 0.1;
// Length of a fade, in seconds: short, but too long for a click.
const FADE = 0.012;
// Seconds of silence after which the sound card gets its rest.
const REST = 0.5;

let context;
let volume;
// When what has come so far will have been played, and what waits for the end of it.
let end = 0;
let rest;

globalThis.harvesterPlay = (samples, rate) => {
  if (samples.length === 0) {
    if (context && rest === undefined) rest = setTimeout(() => context.suspend(), 1000 * REST);
    return;
  }
  clearTimeout(rest);
  rest = undefined;
  if (!context) {
    context = new AudioContext({ sampleRate: rate });
    volume = context.createGain();
    volume.gain.value = 0;
    volume.connect(context.destination);
  }
  // A browser lets a page be heard once it has been clicked on; until then nothing piles up.
  if (context.state !== "running") {
    context.resume();
    end = 0;
    return;
  }
  const piece = context.createBuffer(1, samples.length, rate);
  piece.copyToChannel(samples, 0);
  const gain = volume.gain;
  if (end < context.currentTime + FADE) {
    end = context.currentTime + AHEAD;
    gain.cancelScheduledValues(0);
    gain.setValueAtTime(0, end);
    gain.linearRampToValueAtTime(1, end + FADE);
  } else {
    // It goes on: the fade at the end of the last piece is not needed.
    gain.cancelScheduledValues(end - FADE);
  }
  const player = new AudioBufferSourceNode(context, { buffer: piece });
  player.connect(volume);
  player.start(end);
  end += piece.duration;
  gain.setValueAtTime(1, end - FADE);
  gain.linearRampToValueAtTime(0, end);
};
