'use strict';
// Where the probes of a cube of the asset `environment` lie for a GPU, which finds the face itself.

// The direction (right, up, ahead) of a probe, by its angles alone.
function direction_of(probe) {
    const azimuth = probe.at.azimuth_deg * Math.PI / 180, elevation = probe.at.elevation_deg * Math.PI / 180;
    const level = Math.cos(elevation);
    return [level * Math.sin(azimuth), Math.sin(elevation), level * Math.cos(azimuth)];
}

// The probes of a level whose texels all are of one face: beyond, GPUs blend with the next face, and lookups in the
// strip of faces do not. Each has its direction, its level and its face.
function probes_of_level(probes, level, edge) {
    return probes.flatMap((probe) => {
        const face = Math.floor(6 * probe.uv[1]);
        const in_face = [probe.uv[0], 6 * probe.uv[1] - face];
        const is_within = in_face.every((x) => x * edge >= 0.5 && x * edge <= edge - 0.5);
        return is_within ? [{...probe, direction: direction_of(probe), level, face}] : [];
    });
}

// The probes of the first levels of an asset of the manifest.
function cube_probes(asset, levels) {
    const all = [asset.probes, ...asset.mips.map((mip) => mip.probes)].slice(0, levels);
    return all.flatMap((probes, level) => probes_of_level(probes, level, asset.size[0] >> level));
}

module.exports = {cube_probes, direction_of};
