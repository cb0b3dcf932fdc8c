// For the lecture: full screen, clips of what the canvas shows, and lessons that the address names.

// A clip's address stays good for so long, in milliseconds: some browsers read it late.
const SAVING = 60_000;
const RATE = 30;
const KINDS = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm", "video/mp4"];
const kind = () =>
  window.MediaRecorder && HTMLCanvasElement.prototype.captureStream
    ? KINDS.find((name) => MediaRecorder.isTypeSupported(name))
    : undefined;
let clip = null;

function save(blob, name) {
  const anchor = document.createElement("a");
  anchor.href = URL.createObjectURL(blob);
  anchor.download = name;
  anchor.click();
  setTimeout(() => URL.revokeObjectURL(anchor.href), SAVING);
}

// A part of the canvas, given as fractions, goes through a film of its own size: the canvas itself cannot be looked at
// between two pictures.
async function film(canvas, [left, top, wide, high]) {
  const whole = canvas.captureStream(RATE);
  const video = Object.assign(document.createElement("video"), { muted: true, srcObject: whole });
  await video.play();
  const cut = document.createElement("canvas");
  cut.width = 2 * Math.round((wide * canvas.width) / 2);
  cut.height = 2 * Math.round((high * canvas.height) / 2);
  const brush = cut.getContext("2d");
  const draw = () => {
    if (!clip) return;
    const [x, y] = [video.videoWidth, video.videoHeight];
    brush.drawImage(video, left * x, top * y, wide * x, high * y, 0, 0, cut.width, cut.height);
    requestAnimationFrame(draw);
  };
  clip = {};
  draw();
  return cut.captureStream(RATE);
}

globalThis.harvesterStage = Object.freeze({
  fullScreen: () => {
    const done = document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen?.();
    done?.catch(() => {});
  },
  canRecord: () => Boolean(kind()),
  record: async (name, left, top, wide, high) => {
    const stream = await film(document.getElementById("canvas"), [left, top, wide, high]);
    const recorder = new MediaRecorder(stream, { mimeType: kind(), videoBitsPerSecond: 8e6 });
    const parts = [];
    recorder.ondataavailable = ({ data }) => parts.push(data);
    recorder.onstop = () => {
      const type = recorder.mimeType.split(";")[0];
      save(new Blob(parts, { type }), `${name}.${type.split("/")[1]}`);
    };
    clip = { recorder, stream };
    recorder.start();
  },
  stop: () => {
    clip?.recorder?.stop();
    clip?.stream?.getTracks().forEach((track) => track.stop());
    clip = null;
  },
  // A lesson of the same site, by a name without a way out of its folder.
  fetchLesson: async (name) => {
    if (!/^[\w-][\w./-]*$/.test(name) || name.includes("..") || name.includes("//")) throw new Error("name");
    const response = await fetch(name, { cache: "no-cache" });
    if (!response.ok) throw new Error(String(response.status));
    return response.text();
  },
});
