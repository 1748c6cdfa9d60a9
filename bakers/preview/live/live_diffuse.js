'use strict';
// The diffuse light within a cloud, as cloud_light.h describes it: what live_renderer.js looks up.

// The density of a volume's value, and its voxels as numbers.
function density_of(cloud, value) {
    if (cloud.threshold === null) return Math.max(value, 0);
    if (value <= cloud.threshold) return 0;
    const x = cloud.edge_softness > 0 ? Math.min((value - cloud.threshold) / cloud.edge_softness, 1) : 1;
    return value * x * x * (3 - 2 * x);
}

function densities_by_code(cloud, type) {
    if (type === 'unorm8') return Float32Array.from({length: 256}, (_, i) => density_of(cloud, i / 255));
    return Float32Array.from({length: 65536}, (_, i) => {
        const exponent = (i >> 10) & 31, fraction = i & 1023;
        const size = exponent === 0 ? fraction * 2 ** -24 : (1 + fraction / 1024) * 2 ** (exponent - 15);
        return exponent === 31 ? 0 : density_of(cloud, i & 0x8000 ? -size : size);
    });
}

// The mean density of blocks of 4 x 4 x 4 voxels.
function block_densities(cloud, {size, type, array}) {
    const codes = densities_by_code(cloud, type), [nx, ny, nz] = size;
    const blocks = size.map((n) => Math.ceil(n / 4)), [bx, by] = blocks;
    const sums = new Float64Array(blocks[0] * blocks[1] * blocks[2]), counts = new Float64Array(sums.length);
    // Block k of an axis begins at floor(k N / n).
    const block_of = (n, count) => {
        const of = new Int32Array(n);
        for (let k = 0; k < count; ++k) of.fill(k, Math.floor(k * n / count), Math.floor((k + 1) * n / count));
        return of;
    };
    const of = size.map((n, a) => block_of(n, blocks[a]));
    for (let z = 0, voxel = 0; z < nz; ++z) {
        for (let y = 0; y < ny; ++y) {
            const row = (of[2][z] * by + of[1][y]) * bx;
            for (let x = 0; x < nx; ++x) {
                const block = row + of[0][x];
                sums[block] += codes[array[voxel++]];
                ++counts[block];
            }
        }
    }
    return {blocks, means: Float32Array.from(sums, (sum, i) => sum / counts[i])};
}

// The shares of the sky's and of the ground's diffuse light in each block, by two-stream theory (cloud_light.h), and
// the share that passes the whole layer.
function diffuse_shares(cloud, {blocks: [nx, ny, nz], means}, extinction_factor) {
    const height = cloud.tile[2] / nz, plane = nx * ny;
    const thickness = cloud.backward * cloud.extinction * extinction_factor * height;
    const spread = [nx, ny].map((n, a) => Math.min(0.25, (height * n / cloud.tile[a]) ** 2 / 4));
    const shares = new Float32Array(2 * plane * nz);
    const smoothed = (from, s, along_x) => {
        const to = new Float64Array(plane);
        for (let y = 0; y < ny; ++y) {
            for (let x = 0; x < nx; ++x) {
                const before = along_x ? y * nx + (x + nx - 1) % nx : (y + ny - 1) % ny * nx + x;
                const after = along_x ? y * nx + (x + 1) % nx : (y + 1) % ny * nx + x;
                to[y * nx + x] = (1 - 2 * s) * from[y * nx + x] + s * (from[before] + from[after]);
            }
        }
        return to;
    };
    let through = 1;
    for (const [channel, downwards] of [[0, true], [1, false]]) {
        let share = new Float64Array(plane).fill(1);
        for (let step = 0; step < nz; ++step) {
            const k = downwards ? nz - 1 - step : step;
            share = smoothed(smoothed(share, spread[0], true), spread[1], false);
            for (let i = 0; i < plane; ++i) {
                const depth = thickness * means[k * plane + i];
                shares[2 * (k * plane + i) + channel] = 1 / (1 / share[i] + depth / 2);
                share[i] = 1 / (1 / share[i] + depth);
            }
        }
        if (downwards) through = share.reduce((sum, value) => sum + value, 0) / plane;
    }
    return {shares, through};
}
