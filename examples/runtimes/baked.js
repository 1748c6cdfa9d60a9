// Loads files of a folder of skybake's as its manifest.json describes them.

export const text_of = async (url) => (await fetch(url)).text();

const arrays = {unorm8: Uint8Array, half: Uint16Array, float: Float32Array};

// Level 0 of each asset: {name, pixel_type, channels, size, axes, texels}. The axes u, v and w have `wrap` and
// `filter`.
export async function load_baked(folder, names) {
    const manifest = JSON.parse(await text_of(`${folder}/manifest.json`));
    return Promise.all(names.map(async (name) => {
        const asset = manifest.assets.find((one) => one.name === name);
        const file = asset.files.find(({format, level}) => format === 'bin' && level === 0);
        const bytes = await (await fetch(`${folder}/${file.path}`)).arrayBuffer();
        return {name, pixel_type: file.pixel_type, channels: asset.channels.length, size: asset.size,
            axes: ['u', 'v', 'w'].flatMap((axis) => asset.mapping[axis] ?? []),
            texels: new arrays[file.pixel_type](bytes)};
    }));
}
