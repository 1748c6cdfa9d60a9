// SPDX-License-Identifier: MIT
// Loads a folder of skybake's: the texels that its manifest.json describes, and lookups.glsl, which
//   skybake info --lookup FOLDER > FOLDER/lookups.glsl
// writes. The modules for engines turn both into textures and uniforms.

const arrays = {unorm8: Uint8Array, half: Uint16Array, float: Float32Array};

async function fetched(url, how) {
    const answer = await fetch(url);
    if (!answer.ok) throw new Error(`${url}: ${answer.status} ${answer.statusText}`);
    return answer[how]();
}

// Level 0 of an asset: {name, pixel_type, channels, size, axes, texels}. The axes u, v and w have `wrap` and `filter`.
async function load_asset(folder, manifest, name) {
    const asset = manifest.assets.find((one) => name_in_glsl(one.name) === name);
    if (!asset) throw new Error(`${folder}manifest.json has no asset ${name}, which lookups.glsl reads`);
    const file = asset.files.find(({format, level}) => format === 'bin' && level === 0);
    if (!file || !arrays[file.pixel_type]) {
        throw new Error(`bake ${asset.name} with formats = ["bin"] and pixel_type = "half", "float" or "unorm8"`);
    }
    return {name, pixel_type: file.pixel_type, channels: asset.channels.length, size: asset.size,
        axes: ['u', 'v', 'w'].flatMap((axis) => asset.mapping[axis] ?? []),
        texels: new arrays[file.pixel_type](await fetched(folder + file.path, 'arrayBuffer'))};
}

const name_in_glsl = (name) => name.replace(/[^A-Za-z0-9]+/g, '_');

// The functions of lookups.glsl that are ready to call, with the textures that each takes: {sky: [...], air: [...]}.
function functions_of(glsl) {
    const found = {};
    for (const [, name, list] of glsl.matchAll(/^\w+ skybake_(\w+)\(([^)]*)\)/gm)) {
        found[name] = [...list.matchAll(/sampler[23]D (\w+)_table/g)].map(([, table]) => table);
    }
    if (!found.sky) throw new Error('lookups.glsl has no skybake_sky: bake transmittance and multiple_scattering');
    return found;
}

// Returns {manifest, assets, glsl}. `glsl` has the lookups and, with the world's axes of an engine, the functions
//   vec3 sky(vec3 ray)                      what is seen where there is no cloud, with the ground and the sun
//   Air air(vec3 ray, float distance)       {light, through}: the air before a surface
//   Clouds clouds(vec3 ray)                 {light, through, distance_m}, where the recipe has clouds
//   vec3 seen(vec3 ray, float noise)        all of them
//   vec3 linear_srgb(vec3 light), vec3 shown_by_film(vec3 light)
// Rays have the length 1, and distances are in metres.
export async function load_bake(folder, to_z_up) {
    const base = folder.endsWith('/') ? folder : `${folder}/`;
    const [manifest, lookups] = await Promise.all([fetched(`${base}manifest.json`, 'json'),
        fetched(`${base}lookups.glsl`, 'text')]);
    const functions = functions_of(lookups);
    const names = [...new Set(Object.values(functions).flat())];
    const assets = await Promise.all(names.map((name) => load_asset(base, manifest, name)));
    return {manifest, assets, glsl: lookups + uniforms_of(assets) + wrappers_of(lookups, functions, to_z_up)};
}

const uniforms_of = (assets) => assets.map(({name, size}) =>
    `uniform highp sampler${size.length}D ${name}_table;\n`).join('') +
    'uniform vec3 skybake_camera, skybake_sun;\nuniform float skybake_pixel, skybake_exposure;\n';

function wrappers_of(lookups, functions, to_z_up) {
    const light = lookups.match(/^(\w+) skybake_sky/m)[1];
    const call = (name, more) => {
        const tables = functions[name].map((table) => `${table}_table`).join(', ');
        return `skybake_${name}(${tables}, z_up(skybake_camera), z_up(ray), z_up(skybake_sun), ${more})`;
    };
    const wrappers = [`vec3 z_up(vec3 v) { return ${to_z_up}; }`,
        `${light} sky(vec3 ray) { return ${call('sky', 'skybake_pixel')}; }`,
        `Air air(vec3 ray, float distance) { return ${call('air', 'distance')}; }`];
    if (functions.clouds) {
        wrappers.push(`Clouds clouds(vec3 ray) { return ${call('clouds', '1e6, skybake_pixel, 0.5')}; }`,
            `${light} seen(vec3 ray, float noise) { return ${call('view', 'skybake_pixel, noise')}; }`);
    } else {
        wrappers.push(`${light} seen(vec3 ray, float noise) { return sky(ray); }`);
    }
    return `${wrappers.join('\n')}\n`;
}

// Texels with R, G, B as R, G, B, 1: GPUs have no textures of three channels.
export function texels_for_gpu({pixel_type, channels, texels}) {
    if (channels !== 3) return texels;
    const wide = new texels.constructor(texels.length / 3 * 4).fill({unorm8: 255, half: 0x3c00, float: 1}[pixel_type]);
    for (let i = 0; i < texels.length; i += 3) wide.set(texels.subarray(i, i + 3), i / 3 * 4);
    return wide;
}

// The unit vector to the sun in an engine's world, whose y points up; +x of the recipe stays +x.
export function sun_direction(elevation_degrees, azimuth_degrees, from_z_up) {
    const radians = Math.PI / 180, level = Math.cos(elevation_degrees * radians);
    return from_z_up([level * Math.cos(azimuth_degrees * radians), level * Math.sin(azimuth_degrees * radians),
        Math.sin(elevation_degrees * radians)]);
}

// The angle of a pixel of a perspective camera, in radians.
export const pixel_angle = (vertical_field_radians, height) => 2 * Math.tan(0.5 * vertical_field_radians) / height;

// What the fragment shader of a background calls with the ray of its pixel; it returns sRGB.
export const picture_glsl = `
// Jimenez 2014: neighbouring pixels differ much.
float noise_of_pixel() { return fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))); }
vec4 picture(vec3 ray) { return vec4(shown_by_film(skybake_exposure * seen(ray, noise_of_pixel())), 1.0); }
`;
