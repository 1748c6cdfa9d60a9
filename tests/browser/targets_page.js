// Loads what the targets three, takram and babylon wrote, by their own modules, and reads the textures at the places of
// probes. Runs in the page of targets.js.

// A shader that writes to pixel `i` what the table has at the place in texel `i` of `places`; of a cube, at the
// direction and in the level.
const fragment = (dim, head, color) => `
    uniform highp sampler2D places;
    uniform highp sampler${dim === 'Cube' ? 'Cube' : `${dim}D`} table;
    ${head}
    void main() {
        vec4 at = texelFetch(places, ivec2(int(gl_FragCoord.x), 0), 0);
        ${color} = textureLod(table, ${dim === 2 ? 'at.xy' : 'at.xyz'}, at.w);
    }`;

// The values, four of each place, that three.js finds in the textures of the module.
async function look_up_in_three(url, dim, places) {
    const THREE = await import('three');
    const renderer = new THREE.WebGLRenderer();
    const texture = await (await import(url)).load(renderer);
    const count = places.length / 4;
    const at = new THREE.DataTexture(new Float32Array(places), count, 1, THREE.RGBAFormat, THREE.FloatType);
    at.needsUpdate = true;
    const material = new THREE.RawShaderMaterial({
        glslVersion: THREE.GLSL3,
        uniforms: {places: {value: at}, table: {value: texture}},
        vertexShader: 'in vec3 position; void main() { gl_Position = vec4(position, 1.0); }',
        fragmentShader: fragment(dim, 'precision highp float; out vec4 color;', 'color'),
    });
    const target = new THREE.WebGLRenderTarget(count, 1, {type: THREE.FloatType});
    const quad = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), material);
    quad.frustumCulled = false;
    renderer.setRenderTarget(target);
    renderer.render(new THREE.Scene().add(quad), new THREE.Camera());
    const values = new Float32Array(4 * count);
    renderer.readRenderTargetPixels(target, 0, 0, count, 1, values);
    renderer.dispose();
    return Array.from(values);
}

// The four values that three.js draws as its background in the middle of each view, in float and without tone mapping.
async function look_at_sky_in_three(url, views) {
    const THREE = await import('three');
    const renderer = new THREE.WebGLRenderer();
    const scene = new THREE.Scene();
    scene.background = await (await import(url)).load(renderer);
    const camera = new THREE.PerspectiveCamera(0.01);
    const target = new THREE.WebGLRenderTarget(1, 1, {type: THREE.FloatType});
    renderer.setRenderTarget(target);
    const values = views.flatMap((view) => {
        camera.lookAt(...view);
        renderer.render(scene, camera);
        const value = new Float32Array(4);
        renderer.readRenderTargetPixels(target, 0, 0, 1, 1, value);
        return Array.from(value);
    });
    renderer.dispose();
    return values;
}

// The same as look_up_in_three in Babylon.js.
async function look_up_in_babylon(url, dim, places) {
    const engine = new BABYLON.Engine(document.createElement('canvas'));
    const scene = new BABYLON.Scene(engine);
    const texture = await (await import(url)).load(BABYLON, scene);
    const {Constants, Texture} = BABYLON;
    const count = places.length / 4;
    const at = new BABYLON.RawTexture(new Float32Array(places), count, 1, Constants.TEXTUREFORMAT_RGBA, scene, false,
        false, Texture.NEAREST_SAMPLINGMODE, Constants.TEXTURETYPE_FLOAT);
    const wrapper = new BABYLON.EffectWrapper({
        engine, name: `look_up_${dim}`, samplerNames: ['places', 'table'],
        fragmentShader: fragment(dim, '', 'gl_FragColor'),
    });
    wrapper.onApplyObservable.add(() => {
        wrapper.effect.setTexture('places', at);
        wrapper.effect.setTexture('table', texture);
    });
    await new Promise((resolve) => wrapper.effect.executeWhenCompiled(resolve));
    const target = engine.createRenderTargetTexture({width: count, height: 1}, {
        type: Constants.TEXTURETYPE_FLOAT, format: Constants.TEXTUREFORMAT_RGBA, generateDepthBuffer: false,
        samplingMode: Texture.NEAREST_SAMPLINGMODE, generateMipMaps: false});
    new BABYLON.EffectRenderer(engine).render(wrapper, target);
    const values = await engine._readTexturePixels(target.texture, count, 1);
    engine.dispose();
    return Array.from(values);
}

// The three values, for each normal, of a white matt plane with that normal under the sun of the module.
async function light_in_three(url, normals) {
    const THREE = await import('three');
    const renderer = new THREE.WebGLRenderer();
    const scene = new THREE.Scene();
    const plane = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), new THREE.MeshLambertMaterial());
    scene.add((await import(url)).sunlight(), plane);
    const camera = new THREE.OrthographicCamera();
    const target = new THREE.WebGLRenderTarget(1, 1, {type: THREE.FloatType});
    renderer.setRenderTarget(target);
    const values = normals.map((normal) => {
        plane.lookAt(...normal);
        camera.position.set(...normal);
        camera.lookAt(0, 0, 0);
        renderer.render(scene, camera);
        const value = new Float32Array(4);
        renderer.readRenderTargetPixels(target, 0, 0, 1, 1, value);
        return Array.from(value.slice(0, 3));
    });
    renderer.dispose();
    return values;
}

async function light_in_babylon(url, normals) {
    const engine = new BABYLON.Engine(document.createElement('canvas'));
    const values = [];
    for (const normal of normals) {
        const scene = new BABYLON.Scene(engine);
        (await import(url)).sunlight(BABYLON, scene);
        const toward = new BABYLON.Vector3(...normal);
        const plane = BABYLON.MeshBuilder.CreatePlane('plane', {size: 4}, scene);
        plane.setDirection(toward.scale(-1));  // a plane of Babylon.js faces -z
        plane.material = new BABYLON.PBRMaterial('white', scene);
        Object.assign(plane.material, {metallic: 0, roughness: 1, specularIntensity: 0, metallicF0Factor: 0});
        const camera = new BABYLON.FreeCamera('camera', toward.scale(2), scene);
        camera.setTarget(BABYLON.Vector3.Zero());
        const target = new BABYLON.RenderTargetTexture('seen', 1, scene, {type: BABYLON.Constants.TEXTURETYPE_FLOAT});
        target.renderList = [plane];
        target.activeCamera = camera;
        scene.customRenderTargets.push(target);
        scene.imageProcessingConfiguration.applyByPostProcess = true;  // light as it is
        await scene.whenReadyAsync();
        scene.render();
        values.push(Array.from(await target.readPixels()).slice(0, 3));
        scene.dispose();
    }
    engine.dispose();
    return values;
}

window.light = {three: light_in_three, babylon: light_in_babylon};
window.look_up = {three: look_up_in_three, takram: look_up_in_three, babylon: look_up_in_babylon};
window.look_at_sky = {three: look_at_sky_in_three};
