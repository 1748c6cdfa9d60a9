'use strict';
// Prepares marches through the clouds of a scene, besides their textures: steps, reaches, and the diffuse light of all
// layers in one table (clouds.glsl and light.glsl).

class LiveClouds {
    // `clouds` are the scene's; `volumes` are their textures, in the same order.
    constructor(clouds, volumes) {
        this.clouds = clouds;
        this.blocks = clouds.map((cloud, i) => block_densities(cloud, volumes[i]));
        this.through = clouds.map(() => 1);
        this.mean_sunlight = 1;
        // Layers from the highest down.
        const middle = ({base, tile}) => base + 0.5 * tile[2];
        this.falling = clouds.map((_, i) => i).sort((a, b) => middle(clouds[b]) - middle(clouds[a]));
    }

    // The shares of the sky's and of the ground's light in the blocks of all layers, one above the other, each with one
    // more block on every side: the next tile's along x and y, the outermost along z.
    share_table(extinction) {
        const inner = this.blocks.map(({blocks}) => blocks);
        const size = [0, 1, 2].map((a) => a < 2 ? Math.max(...inner.map((one) => one[a] + 2))
            : inner.reduce((sum, one) => sum + one[2] + 2, 0));
        const array = new Float32Array(2 * size[0] * size[1] * size[2]);
        let begin = 0;
        this.share_of = inner.map(([nx, ny, nz], i) => {
            const {shares, through} = diffuse_shares(this.clouds[i], this.blocks[i], extinction);
            this.through[i] = through;
            for (let z = 0; z < nz + 2; ++z) {
                const from_z = Math.min(Math.max(z - 1, 0), nz - 1);
                for (let y = 0; y < ny + 2; ++y) {
                    for (let x = 0; x < nx + 2; ++x) {
                        const from = 2 * ((from_z * ny + (y + ny - 1) % ny) * nx + (x + nx - 1) % nx);
                        array.set(shares.subarray(from, from + 2), 2 * (((begin + z) * size[1] + y) * size[0] + x));
                    }
                }
            }
            begin += nz + 2;
            return [nx, ny, nz, begin - nz - 2];
        });
        return {name: 'share_table', label: 'diffuse light, made by the page', size, channels: 2, type: 'float', array};
    }

    // The values of the shaders. `coarse` lengthens the steps of a march.
    values(view, sun, coarse) {
        const steps = this.clouds.map((cloud) => this.steps_of(cloud, view, sun, coarse));
        const each = (name) => ({array: steps.map((step) => step[name]), width: 1});
        return {extinction_factor: view.extinction, repeats: !view.single, view_step: each('step'),
            sun_step: each('sun_step'), sun_samples: each('sun_samples'), reach: each('reach'),
            fade: {array: steps.flatMap(({fade}) => fade), width: 2},
            share_of: {array: this.share_of.flat(), width: 4}, ...this.shares(view)};
    }

    steps_of(cloud, view, sun, coarse) {
        const [x, y, height] = cloud.tile, longest = view.single ? Math.hypot(x, y) : Math.max(x, y);
        const slope = Math.abs(sun[2]), march = slope * longest > height ? height / slope : longest;
        const step = coarse * cloud.step, sun_step = Math.max(coarse * cloud.voxel_edge, march / cloud.most_sun_samples);
        const reach = view.single ? 1e6 : this.reach_of(cloud, view);
        return {step, sun_step, sun_samples: Math.ceil(march / sun_step), reach,
            fade: view.single ? [0, 0] : [cloud.fade_from * reach, reach]};
    }

    // The reach_m_from of bakers/march/layer_march.h.
    reach_of({base, tile, reach, farthest_reach, end_slope}, {position}) {
        const height = Math.abs(base + 0.5 * tile[2] - position[2]);
        return Math.max(reach, Math.min(height / end_slope, farthest_reach));
    }

    // Returns the shares of diffuse light and of the sun's that layers leave. A tile alone covers no share of the sky.
    shares(view) {
        const sky = [];
        let through = 1;
        for (const i of this.falling) {
            sky[i] = through;
            through *= this.through[i];
        }
        return {sky_share: {array: sky, width: 1}, ground_share: through,
            ground_through: view.single ? 1 : through, mean_sunlight: view.single ? 1 : this.mean_sunlight};
    }

    // Takes the sunlight that passes each layer, as direct.glsl draws it: squares of pixels, one for each layer.
    take_direct(floats) {
        const count = floats.length / 4 / this.clouds.length;
        this.mean_sunlight = 1;
        for (let i = 0; i < this.clouds.length; ++i) {
            let sum = 0;
            for (let at = 0; at < count; ++at) sum += floats[4 * (i * count + at)];
            this.mean_sunlight *= sum / count;
        }
    }
}
