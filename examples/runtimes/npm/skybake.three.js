// SPDX-License-Identifier: MIT
// A sky of skybake's in three.js, whose world is in metres with y up:
//   const sky = await Skybake.load('out/');
//   scene.add(sky.background());
//   renderer.setAnimationLoop(() => { sky.update(camera, renderer); renderer.render(scene, camera); });
import * as THREE from 'three';
import {load_bake, picture_glsl, pixel_angle, sun_direction, texels_for_gpu} from './skybake.js';

const types = {unorm8: THREE.UnsignedByteType, half: THREE.HalfFloatType, float: THREE.FloatType};

function texture_of(asset) {
    const {pixel_type, channels, size, axes} = asset, data = texels_for_gpu(asset);
    const texture = size.length === 3 ? new THREE.Data3DTexture(data, ...size) : new THREE.DataTexture(data, ...size);
    texture.format = [, THREE.RedFormat, THREE.RGFormat, THREE.RGBAFormat, THREE.RGBAFormat][channels];
    texture.type = types[pixel_type];
    axes.forEach(({wrap}, i) => {
        texture[['wrapS', 'wrapT', 'wrapR'][i]] = wrap === 'repeat' ? THREE.RepeatWrapping : THREE.ClampToEdgeWrapping;
    });
    texture.minFilter = texture.magFilter = axes[0].filter === 'nearest' ? THREE.NearestFilter : THREE.LinearFilter;
    texture.unpackAlignment = 1;
    texture.needsUpdate = true;
    return texture;
}

export class Skybake {
    static async load(folder) {
        return new Skybake(await load_bake(folder, 'vec3(v.x, -v.z, v.y)'));
    }

    // `glsl` declares the uniforms, and has the functions that skybake.js lists.
    constructor({manifest, assets, glsl}) {
        Object.assign(this, {manifest, glsl});
        this.textures = Object.fromEntries(assets.map((asset) => [asset.name, texture_of(asset)]));
        this.uniforms = {skybake_camera: {value: new THREE.Vector3()}, skybake_sun: {value: new THREE.Vector3(1, 0, 0)},
            skybake_pixel: {value: 0.001}, skybake_exposure: {value: 12}};
        for (const [name, value] of Object.entries(this.textures)) this.uniforms[`${name}_table`] = {value};
        this.set_sun(20, 0);
    }

    // Azimuths turn from +x towards -z, seen from above to the left.
    set_sun(elevation_degrees, azimuth_degrees) {
        this.uniforms.skybake_sun.value.set(...sun_direction(elevation_degrees, azimuth_degrees, ([x, y, z]) => [x, z, -y]));
    }

    // Takes the camera's place and the size of a pixel. Call it before each frame.
    update(camera, renderer) {
        camera.updateMatrixWorld();
        camera.getWorldPosition(this.uniforms.skybake_camera.value);
        const height = renderer.getDrawingBufferSize(new THREE.Vector2()).y;
        this.uniforms.skybake_pixel.value = pixel_angle(camera.fov * Math.PI / 180, height);
    }

    // A mesh that fills what nothing else covers with sky, ground and clouds. It writes sRGB.
    background() {
        const material = new THREE.ShaderMaterial({glslVersion: THREE.GLSL3, uniforms: this.uniforms, depthTest: false,
            depthWrite: false, toneMapped: false,
            vertexShader: `out vec3 ray;
                void main() {
                    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
                    ray = mat3(inverse(viewMatrix)) * (inverse(projectionMatrix) * vec4(corner, 1.0, 1.0)).xyz;
                    gl_Position = vec4(corner, 1.0, 1.0);
                }`,
            fragmentShader: `in vec3 ray;\nout vec4 color;\n${this.glsl}${picture_glsl}
                void main() { color = picture(normalize(ray)); }`});
        const triangle = new THREE.BufferGeometry();
        triangle.setAttribute('position', new THREE.BufferAttribute(new Float32Array(9), 3));
        const mesh = new THREE.Mesh(triangle, material);
        mesh.frustumCulled = false;
        mesh.renderOrder = -1e9;
        return mesh;
    }

    // Lets a material of three.js lie behind the air: its own colour is dimmed, and the air's light is added.
    add_air(material) {
        material.onBeforeCompile = (shader) => {
            Object.assign(shader.uniforms, this.uniforms);
            shader.vertexShader = shader.vertexShader.replace('#include <common>', '#include <common>\nvarying vec3 skybake_place;')
                .replace('#include <project_vertex>', '#include <project_vertex>\n' +
                    'skybake_place = (modelMatrix * vec4(transformed, 1.0)).xyz;');
            shader.fragmentShader = shader.fragmentShader.replace('#include <common>',
                `#include <common>\nvarying vec3 skybake_place;\n${this.glsl}`)
                .replace('#include <opaque_fragment>', `{
                    vec3 way = skybake_place - skybake_camera;
                    Air before = air(normalize(way), length(way));
                    vec3 through = linear_srgb(before.through) / linear_srgb(before.through * 0.0 + 1.0);
                    outgoingLight = through * outgoingLight + skybake_exposure * linear_srgb(before.light);
                }\n#include <opaque_fragment>`);
        };
        material.needsUpdate = true;
        return material;
    }
}
