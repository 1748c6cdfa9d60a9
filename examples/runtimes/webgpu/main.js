// Draws a folder of skybake's with WebGPU.
import {load_baked, text_of} from '../baked.js';
import {uniforms_of} from '../view.js';

// Formats of texels by the manifest's pixel type and number of channels; WebGPU has none of three channels, and
// filters these without further features. `one` is the number 1.
const formats = {
    unorm8: {bytes: 1, one: 255, names: [, 'r8unorm', , , 'rgba8unorm']},
    half: {bytes: 2, one: 0x3c00, names: [, 'r16float', , , 'rgba16float']},
};

// R, G, B as R, G, B, 1.
function widened(texels, one) {
    const wide = new texels.constructor(texels.length / 3 * 4).fill(one);
    for (let i = 0; i < texels.length; i += 3) wide.set(texels.subarray(i, i + 3), i / 3 * 4);
    return wide;
}

function texture_of(device, {pixel_type, channels, size, texels}) {
    const {bytes, one, names} = formats[pixel_type];
    const stored = channels === 3 ? 4 : channels;
    const texture = device.createTexture({size, dimension: `${size.length}d`, format: names[stored],
        usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST});
    device.queue.writeTexture({texture}, channels === 3 ? widened(texels, one) : texels,
        {bytesPerRow: bytes * stored * size[0], rowsPerImage: size[1]}, size);
    return texture.createView();
}

// A sampler that wraps and filters as the asset's mapping says.
function sampler_of(device, {axes}) {
    const wraps = axes.map(({wrap}) => (wrap === 'repeat' ? 'repeat' : 'clamp-to-edge'));
    const filter = axes[0].filter === 'nearest' ? 'nearest' : 'linear';
    return device.createSampler({addressModeU: wraps[0], addressModeV: wraps[1], addressModeW: wraps[2],
        magFilter: filter, minFilter: filter});
}

async function shader_of(folder) {
    const here = (name) => new URL(name, import.meta.url);
    return (await Promise.all([here('picture.wgsl'), `${folder}/lookups.wgsl`].map(text_of))).join('\n');
}

// Returns `draw`, which takes a view.
export async function renderer(canvas, folder) {
    const device = await (await navigator.gpu.requestAdapter()).requestDevice();
    device.addEventListener('uncapturederror', ({error}) => console.error(error.message));
    const format = navigator.gpu.getPreferredCanvasFormat();
    const context = canvas.getContext('webgpu');
    context.configure({device, format});
    const module = device.createShaderModule({code: await shader_of(folder)});
    const pipeline = device.createRenderPipeline({layout: 'auto', vertex: {module, entryPoint: 'corner'},
        fragment: {module, entryPoint: 'picture', targets: [{format}]}});

    const assets = await load_baked(folder, ['transmittance', 'multiple_scattering', 'cloud', 'cells']);
    const uniforms = device.createBuffer({size: 96, usage: GPUBufferUsage.UNIFORM | GPUBufferUsage.COPY_DST});
    const bound = assets.flatMap((asset) => [texture_of(device, asset), sampler_of(device, asset)]);
    bound.pop();                                    // cells are fetched, not sampled
    const group = device.createBindGroup({layout: pipeline.getBindGroupLayout(0),
        entries: [{buffer: uniforms}, ...bound].map((resource, binding) => ({binding, resource}))});

    return (view) => {
        [canvas.width, canvas.height] = view.size;
        device.queue.writeBuffer(uniforms, 0, uniforms_of(view));
        const commands = device.createCommandEncoder();
        const pass = commands.beginRenderPass({colorAttachments: [
            {view: context.getCurrentTexture().createView(), loadOp: 'clear', storeOp: 'store'}]});
        pass.setPipeline(pipeline);
        pass.setBindGroup(0, group);
        pass.draw(3);
        pass.end();
        device.queue.submit([commands.finish()]);
    };
}
