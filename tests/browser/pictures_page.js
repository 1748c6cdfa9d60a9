'use strict';
// Pictures as bytes of RGBA, row 0 at the top.

function bytes_of(source, width, height) {
    const canvas = Object.assign(document.createElement('canvas'), {width, height});
    const context = canvas.getContext('2d', {willReadFrequently: true});
    context.imageSmoothingQuality = 'high';
    context.drawImage(source, 0, 0, width, height);
    return context.getImageData(0, 0, width, height).data;
}

// Returns the bytes of a picture at the given size, or else at its own.
window.picture = async (url, width, height) => {
    const image = new Image();
    image.src = url;
    await image.decode();
    return Array.from(bytes_of(image, width ?? image.naturalWidth, height ?? image.naturalHeight));
};

window.upside_down = (canvas) => {
    const turned = Object.assign(document.createElement('canvas'), {width: canvas.width, height: canvas.height});
    const context = turned.getContext('2d');
    context.scale(1, -1);
    context.drawImage(canvas, 0, -canvas.height);
    return turned;
};

// A canvas, with the means of squares of edge x edge pixels.
window.reduced = (canvas, edge) => {
    const bytes = bytes_of(canvas, canvas.width, canvas.height);
    const width = canvas.width / edge, height = canvas.height / edge;
    const means = new Array(4 * width * height).fill(0);
    for (let y = 0; y < canvas.height; ++y) {
        for (let x = 0; x < 4 * canvas.width; ++x) {
            const to = 4 * (Math.floor(y / edge) * width + Math.floor((x >> 2) / edge)) + (x & 3);
            means[to] += bytes[4 * canvas.width * y + x] / edge ** 2;
        }
    }
    return means;
};
