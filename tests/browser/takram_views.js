'use strict';
// The pictures of takram_sky.js, and what skybake's direct integration says that their pixels are.
//
// A view: altitude_km, sun_elevation, heading (to the right from the sun), pitch, fov (from the lower
// edge to the upper one), size; angles in degrees. With `shows_ground` the ground reflects light.

const radians = (degrees) => degrees * Math.PI / 180;

// The ray through a pixel's centre: the cosine of its zenith angle, its azimuth from the sun.
function ray_of(view, pixel) {
    const [width, height] = view.size;
    const tangent = Math.tan(radians(view.fov) / 2);
    const right = (2 * (pixel % width + 0.5) / width - 1) * tangent * width / height;
    const up = (1 - 2 * (Math.floor(pixel / width) + 0.5) / height) * tangent;
    const pitch = radians(view.pitch), heading = radians(view.heading);
    const ahead = Math.cos(pitch) - up * Math.sin(pitch);
    return {mu: (Math.sin(pitch) + up * Math.cos(pitch)) / Math.hypot(1, right, up),
            azimuth: Math.atan2(right, ahead) + heading};
}

const all_pixels = (view) => Array.from({length: view.size[0] * view.size[1]}, (_, pixel) => pixel);

const dip = (ground_km, altitude_km) => Math.acos(ground_km / (ground_km + altitude_km));

const meets_ground = (view, ground_km, pixel) =>
    Math.asin(ray_of(view, pixel).mu) < -dip(ground_km, view.altitude_km);

// Returns a section that gathers the light on a ray through each pixel up to a distance beyond the air, without the
// ground that it may meet.
const gathered_section = (name, view) => `
[bake.${name}]
asset = "aerial_perspective"
content = "in_scatter"
altitude = "${view.altitude_km} km"
sun_elevation = "${view.sun_elevation} deg"
heading = "${view.heading} deg"
pitch = "${view.pitch} deg"
fov = "${view.fov} deg"
aspect = ${view.size[0] / view.size[1]}
view_distance = "4000 km"
slices = "linear"
slices_begin = "camera"
size = [${view.size}, 1]
formats = ["bin"]
pixel_type = "float"
`;

// All around a camera, the ground with the light that it reflects.
const sky_view_section = (name, views) => `
[bake.${name}]
asset = "sky_view"
altitude = "${views[0].altitude_km} km"
sun_elevations = [${views.map((view) => `"${view.sun_elevation} deg"`)}]
pixel_type = "float"
`;

// The colours of a pixel's ray by table k of n in a sky view, whose last row comes first.
function look_up_sky_view(table, ground_km, view, pixel, k, n) {
    const rows = table.height / n, columns = table.width;
    const {mu, azimuth} = ray_of(view, pixel);
    const horizon = dip(ground_km, view.altitude_km);
    const angle = Math.asin(mu) + horizon;
    const y = angle < 0 ? 0.5 - 0.5 * Math.sqrt(-angle / (Math.PI / 2 - horizon))
                        : 0.5 + 0.5 * Math.sqrt(angle / (Math.PI / 2 + horizon));
    const row = angle < 0 ? Math.min(y * (rows - 1), rows / 2 - 1) : Math.max(y * (rows - 1), rows / 2);
    const column = Math.acos(Math.cos(azimuth)) / Math.PI * (columns - 1);
    const texel = (i, j, c) => table.data[4 * ((table.height - 1 - (k * rows + j)) * columns + i) + c];
    const low = (x, count) => Math.min(Math.floor(x), count - 2);
    const i = low(column, columns), j = low(row, rows), s = column - i, t = row - j;
    return [0, 1, 2].map((c) => (1 - t) * ((1 - s) * texel(i, j, c) + s * texel(i + 1, j, c)) +
                                t * ((1 - s) * texel(i, j + 1, c) + s * texel(i + 1, j + 1, c)));
}

// Errors of pixels, relative to max(reference, 1e-3 of the largest): [pixel][colour].
function errors_of(picture, reference, pixels) {
    const floor = 1e-3 * Math.max(...pixels.flatMap((pixel) => reference.slice(3 * pixel, 3 * pixel + 3)));
    return pixels.map((pixel) => [0, 1, 2].map((c) => {
        const value = reference[3 * pixel + c];
        return Math.abs(picture[3 * pixel + c] - value) / Math.max(value, floor);
    }));
}

function statistics(errors) {
    const sorted = errors.slice().sort((a, b) => a - b);
    const at = (share) => sorted[Math.round(share * (sorted.length - 1))];
    return {median: at(0.5), p90: at(0.9), max: at(1)};
}

module.exports = {all_pixels, errors_of, gathered_section, look_up_sky_view, meets_ground, sky_view_section,
                  statistics};
