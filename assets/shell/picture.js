// Makes a picture of a drawing and saves it: browsers draw SVG, so that the app need not.

// A picture's address stays good for so long, in milliseconds: some browsers read it late.
const SAVING = 60_000;

function toBlob(canvas) {
  return new Promise((resolve, reject) => {
    canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error("the picture is too large"))), "image/png");
  });
}

globalThis.harvesterSavePicture = async (name, drawing, scale) => {
  const source = URL.createObjectURL(new Blob([drawing], { type: "image/svg+xml" }));
  try {
    const image = new Image();
    image.src = source;
    await image.decode();
    const canvas = document.createElement("canvas");
    canvas.width = scale * image.naturalWidth;
    canvas.height = scale * image.naturalHeight;
    canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
    const address = URL.createObjectURL(await toBlob(canvas));
    const anchor = document.createElement("a");
    anchor.href = address;
    anchor.download = name;
    anchor.click();
    setTimeout(() => URL.revokeObjectURL(address), SAVING);
  } finally {
    URL.revokeObjectURL(source);
  }
};
