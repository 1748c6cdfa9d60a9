'use strict';
// White planes under the lamp that stands for the sun of an asset `environment`. Directions are (right, up, ahead).

// The normals of planes that face the sun, upwards and to all sides.
const normals_of = (asset) => [asset.details.sun_direction, [0, 1, 0], [0.6, 0.8, 0], [-0.6, 0.8, 0], [0, 0.6, 0.8],
                               [0, 0.6, -0.8]];

// The light of each channel that a plane reflects: the irradiance that falls on it over pi.
function reflected(asset, normal) {
    const {sun_direction: sun, sun_irradiance: irradiance} = asset.details;
    const cosine = Math.max(0, normal.reduce((sum, x, axis) => sum + x * sun[axis], 0));
    return irradiance.map((light) => light * cosine / Math.PI);
}

// Returns the faults of what was found on the planes: differences above `most` from what `shown` makes of the light.
function faults_of_lamp(asset, found, shown, most) {
    return normals_of(asset).flatMap((normal, i) => {
        const wanted = reflected(asset, normal).map(shown);
        return wanted.every((value, c) => Math.abs(found[i][c] - value) <= most) ? [] :
            [`${asset.name}: the plane that faces ${normal} has ${found[i]}, not ${wanted}`];
    });
}

module.exports = {faults_of_lamp, normals_of};
