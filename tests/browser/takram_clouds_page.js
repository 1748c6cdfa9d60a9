// The textures of @takram/three-clouds by the loaders that the package uses (r3f/Clouds.tsx), with the options that it
// gives them. Runs in the page of takram_clouds.js.
import {CLOUD_SHAPE_DETAIL_TEXTURE_SIZE, CLOUD_SHAPE_TEXTURE_SIZE, CloudsEffect} from '@takram/three-clouds';
import {DataTextureLoader, parseUint8Array, STBNLoader} from '@takram/three-geospatial';
import * as THREE from 'three';

const loaded = (loader, url) => new Promise((resolve, reject) => loader.load(url, resolve, undefined, reject));

async function picture(url) {
    const texture = await loaded(new THREE.TextureLoader(), url);
    texture.minFilter = THREE.LinearMipMapLinearFilter;
    texture.magFilter = THREE.LinearFilter;
    texture.wrapS = THREE.RepeatWrapping;
    texture.wrapT = THREE.RepeatWrapping;
    texture.colorSpace = THREE.NoColorSpace;
    texture.needsUpdate = true;
    return texture;
}

const volume = (size) => (url) => loaded(new DataTextureLoader(THREE.Data3DTexture, parseUint8Array, {
    width: size, height: size, depth: size, format: THREE.RedFormat,
    minFilter: THREE.LinearFilter, magFilter: THREE.LinearFilter,
    wrapS: THREE.RepeatWrapping, wrapT: THREE.RepeatWrapping, wrapR: THREE.RepeatWrapping,
    colorSpace: THREE.NoColorSpace,
}), url);

const loaders = {
    local_weather: picture,
    turbulence: picture,
    shape: volume(CLOUD_SHAPE_TEXTURE_SIZE),
    shape_detail: volume(CLOUD_SHAPE_DETAIL_TEXTURE_SIZE),
    stbn: (url) => loaded(new STBNLoader(), url),
};

// The values, four of each place, of a texture of that name. `upside_down` exchanges v for 1 - v.
window.look_up = async (name, url, places, upside_down) => {
    const renderer = new THREE.WebGLRenderer();
    const texture = await loaders[name](url);
    const is_volume = texture.isData3DTexture === true;
    const count = places.length / 4;
    const at = new THREE.DataTexture(new Float32Array(places), count, 1, THREE.RGBAFormat, THREE.FloatType);
    at.needsUpdate = true;
    const material = new THREE.RawShaderMaterial({
        glslVersion: THREE.GLSL3,
        uniforms: {places: {value: at}, table: {value: texture}},
        vertexShader: 'in vec3 position; void main() { gl_Position = vec4(position, 1.0); }',
        fragmentShader: `
            precision highp float;
            uniform highp sampler2D places;
            uniform highp sampler${is_volume ? '3D' : '2D'} table;
            out vec4 color;
            void main() {
                vec4 at = texelFetch(places, ivec2(int(gl_FragCoord.x), 0), 0);
                ${upside_down ? 'at.y = 1.0 - at.y;' : ''}
                color = textureLod(table, ${is_volume ? 'at.xyz' : 'at.xy'}, 0.0);
            }`,
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
};

// Gives the textures to the package's effect, and says what it has not taken.
window.faults_of_effect = async (folder) => {
    const effect = new CloudsEffect(new THREE.PerspectiveCamera());
    effect.localWeatherTexture = await loaders.local_weather(`${folder}local_weather.png`);
    effect.shapeTexture = await loaders.shape(`${folder}shape.bin`);
    effect.shapeDetailTexture = await loaders.shape_detail(`${folder}shape_detail.bin`);
    effect.turbulenceTexture = await loaders.turbulence(`${folder}turbulence.png`);
    effect.stbnTexture = await loaders.stbn(`${folder}stbn.bin`);
    const uniforms = effect.cloudsPass.currentMaterial.uniforms;
    const names = ['localWeatherTexture', 'shapeTexture', 'shapeDetailTexture', 'turbulenceTexture', 'stbnTexture'];
    return names.filter((name) => uniforms[name].value === null || uniforms[name].value !== effect[name])
        .map((name) => `the effect has not taken ${name}`);
};
