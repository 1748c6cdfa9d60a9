'use strict';
// Runs one function of a shader for many arguments. A job has `text`, the shader; `textures` of float
// texels, which lie in calls/; and `given`, `columns` numbers of four components in each of `rows` rows.
// The result has four numbers for each row.

const files = new Map();

async function texels_of({texture}) {
    if (!files.has(texture)) {
        const answer = await fetch(`calls/${texture}.f32`);
        files.set(texture, new Float32Array(await answer.arrayBuffer()));
    }
    return files.get(texture);
}

// In the opposite order: every axis the wrong way round.
function reversed(texels) {
    const turned = new Float32Array(texels.length);
    for (let i = 0; i < texels.length; i += 4) turned.set(texels.subarray(i, i + 4), texels.length - 4 - i);
    return turned;
}

window.results_of = async (run, job) => {
    const textures = await Promise.all(job.textures.map(async (one) => ({...one, texels: await texels_of(one)})));
    const turned = textures.map((one) => ({...one, texels: reversed(one.texels)}));
    return {found: await run({...job, textures}), reversed: await run({...job, textures: turned})};
};

// --- WebGL 2: one pixel for a row ---------------------------------------------------------------

const gl = document.createElement('canvas').getContext('webgl2');
gl.getExtension('EXT_color_buffer_float');
if (!gl.getExtension('OES_texture_float_linear')) throw new Error('float textures are not filtered here');

function compiled(type, text) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader) + text);
    return shader;
}

const targets = {'2D': gl.TEXTURE_2D, '3D': gl.TEXTURE_3D, '2DArray': gl.TEXTURE_2D_ARRAY};

function texture_of({size, repeats, kind, texels}, unit, filter) {
    const target = targets[kind];
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(target, gl.createTexture());
    if (kind === '2D') gl.texImage2D(target, 0, gl.RGBA32F, size[0], size[1], 0, gl.RGBA, gl.FLOAT, texels);
    else gl.texImage3D(target, 0, gl.RGBA32F, ...size, 0, gl.RGBA, gl.FLOAT, texels);
    [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T, gl.TEXTURE_WRAP_R].forEach(
        (axis, i) => gl.texParameteri(target, axis, repeats[i] ? gl.REPEAT : gl.CLAMP_TO_EDGE));
    gl.texParameteri(target, gl.TEXTURE_MIN_FILTER, filter);
    gl.texParameteri(target, gl.TEXTURE_MAG_FILTER, filter);
}

window.run_in_webgl = ({name, text, textures, rows, columns, given}) => {
    const program = gl.createProgram();
    gl.attachShader(program, compiled(gl.VERTEX_SHADER, `#version 300 es
        void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }`));
    gl.attachShader(program, compiled(gl.FRAGMENT_SHADER, text));
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(`${name}: ${gl.getProgramInfoLog(program)}`);
    gl.useProgram(program);
    textures.forEach((texture, i) => texture_of(texture, i, gl.LINEAR));
    texture_of({size: [columns, rows], repeats: [], kind: '2D', texels: new Float32Array(given)}, textures.length, gl.NEAREST);
    // SPIRV-Cross names a texture after itself and each of its samplers: SPIRV_Cross_Combinedt0t0_sampler.
    for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); ++i) {
        const uniform = gl.getActiveUniform(program, i).name;
        const texture = /^(?:SPIRV_Cross_Combined)?t(\d)/.exec(uniform);
        gl.uniform1i(gl.getUniformLocation(program, uniform), texture ? Number(texture[1]) : textures.length);
    }
    gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
    gl.bindRenderbuffer(gl.RENDERBUFFER, gl.createRenderbuffer());
    gl.renderbufferStorage(gl.RENDERBUFFER, gl.RGBA32F, rows, 1);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.RENDERBUFFER, gl.getParameter(gl.RENDERBUFFER_BINDING));
    gl.viewport(0, 0, rows, 1);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    const found = new Float32Array(4 * rows);
    gl.readPixels(0, 0, rows, 1, gl.RGBA, gl.FLOAT, found);
    if (gl.getError() !== gl.NO_ERROR) throw new Error(`${name}: WebGL has an error`);
    return Array.from(found);
};

// --- WebGPU: one invocation for a row -----------------------------------------------------------

const device = navigator.gpu.requestAdapter().then(
    (adapter) => adapter.requestDevice({requiredFeatures: ['float32-filterable']}));

function buffer_of(gpu, numbers, usage) {
    const buffer = gpu.createBuffer({size: 4 * numbers.length, usage: usage | GPUBufferUsage.COPY_DST});
    gpu.queue.writeBuffer(buffer, 0, new Float32Array(numbers));
    return buffer;
}

const view_dimensions = {'2D': '2d', '3D': '3d', '2DArray': '2d-array'};

function view_of(gpu, {size, kind, texels}) {
    const dimension = kind === '3D' ? '3d' : '2d';
    const texture = gpu.createTexture({size, dimension, format: 'rgba32float',
        usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST});
    gpu.queue.writeTexture({texture}, texels, {bytesPerRow: 16 * size[0], rowsPerImage: size[1]}, size);
    return texture.createView({dimension: view_dimensions[kind]});
}

function sampler_of(gpu, {repeats}) {
    const [addressModeU, addressModeV, addressModeW] = repeats.map((does) => (does ? 'repeat' : 'clamp-to-edge'));
    return gpu.createSampler({addressModeU, addressModeV, addressModeW, magFilter: 'linear', minFilter: 'linear'});
}

window.run_in_webgpu = async ({name, text, textures, rows, given}) => {
    const gpu = await device;
    gpu.pushErrorScope('validation');
    const module = gpu.createShaderModule({code: text});
    const {messages} = await module.getCompilationInfo();
    if (messages.length > 0) throw new Error(`${name}, line ${messages[0].lineNum}: ${messages[0].message}\n${text}`);
    const visibility = GPUShaderStage.COMPUTE;
    const found = buffer_of(gpu, new Array(4 * rows).fill(NaN), GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC);
    const bound = [
        [{buffer: {type: 'read-only-storage'}}, {buffer: buffer_of(gpu, given, GPUBufferUsage.STORAGE)}],
        [{buffer: {type: 'storage'}}, {buffer: found}],
        ...textures.flatMap((one) => [
            [{texture: {viewDimension: view_dimensions[one.kind]}}, view_of(gpu, one)],
            [{sampler: {}}, sampler_of(gpu, one)]]),
    ];
    const layout = gpu.createBindGroupLayout({entries: bound.map(([entry], binding) => ({binding, visibility, ...entry}))});
    const pipeline = gpu.createComputePipeline({
        layout: gpu.createPipelineLayout({bindGroupLayouts: [layout]}), compute: {module, entryPoint: 'main'}});
    const commands = gpu.createCommandEncoder();
    const pass = commands.beginComputePass();
    pass.setPipeline(pipeline);
    pass.setBindGroup(0, gpu.createBindGroup({layout, entries: bound.map(([, resource], binding) => ({binding, resource}))}));
    pass.dispatchWorkgroups(Math.ceil(rows / 64));
    pass.end();
    const read = gpu.createBuffer({size: found.size, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST});
    commands.copyBufferToBuffer(found, 0, read, 0, found.size);
    gpu.queue.submit([commands.finish()]);
    const error = await gpu.popErrorScope();
    if (error) throw new Error(`${name}: ${error.message}`);
    await read.mapAsync(GPUMapMode.READ);
    return Array.from(new Float32Array(read.getMappedRange()));
};
