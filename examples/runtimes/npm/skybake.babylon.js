// SPDX-License-Identifier: MIT
// A sky of skybake's in Babylon.js, whose world is in metres, left-handed, with y up:
//   const sky = await Skybake.load('out/', scene);
//   sky.background();
import {Constants, Effect, MaterialPluginBase, Mesh, RawTexture, RawTexture3D, ShaderMaterial, Vector3, VertexData} from '@babylonjs/core';
import {load_bake, picture_glsl, pixel_angle, sun_direction, texels_for_gpu} from './skybake.js';

const types = {unorm8: Constants.TEXTURETYPE_UNSIGNED_BYTE, half: Constants.TEXTURETYPE_HALF_FLOAT,
    float: Constants.TEXTURETYPE_FLOAT};

function texture_of(asset, scene) {
    const {pixel_type, channels, size, axes} = asset, data = texels_for_gpu(asset);
    const format = [, Constants.TEXTUREFORMAT_RED, Constants.TEXTUREFORMAT_RG, Constants.TEXTUREFORMAT_RGBA,
        Constants.TEXTUREFORMAT_RGBA][channels];
    const filter = axes[0].filter === 'nearest' ? Constants.TEXTURE_NEAREST_SAMPLINGMODE : Constants.TEXTURE_BILINEAR_SAMPLINGMODE;
    const texture = size.length === 3
        ? new RawTexture3D(data, ...size, format, scene, false, false, filter, types[pixel_type])
        : new RawTexture(data, ...size, format, scene, false, false, filter, types[pixel_type]);
    axes.forEach(({wrap}, i) => {
        texture[['wrapU', 'wrapV', 'wrapR'][i]] = wrap === 'repeat' ? Constants.TEXTURE_WRAP_ADDRESSMODE : Constants.TEXTURE_CLAMP_ADDRESSMODE;
    });
    return texture;
}

const uniforms = ['skybake_camera', 'skybake_sun', 'skybake_pixel', 'skybake_exposure'];

const skies = new WeakMap();

// What a material of Babylon.js does before its fog. The colour of a StandardMaterial is sRGB there, that of all others
// is linear.
class Air extends MaterialPluginBase {
    constructor(material, sky) {
        skies.set(material, sky);  // the base asks for the code already
        super(material, 'SkybakeAir', 200, {SKYBAKE_AIR: true});
        this._enable(true);
    }

    get sky() { return skies.get(this._material); }
    getClassName() { return 'SkybakeAir'; }
    getUniforms() { return {externalUniforms: uniforms}; }
    getSamplers(samplers) { samplers.push(...Object.keys(this.sky.textures).map((name) => `${name}_table`)); }
    bindForSubMesh(buffer, scene, engine, {effect}) { this.sky.bind(effect); }

    getCustomCode(type) {
        if (type !== 'fragment') return null;
        const is_srgb = this._material.getClassName() === 'StandardMaterial', seen = is_srgb ? 'color' : 'finalColor';
        const behind = is_srgb ? `toLinearSpace(${seen}.rgb)` : `${seen}.rgb`, all = 'through * behind + skybake_exposure * linear_srgb(before.light)';
        return {CUSTOM_FRAGMENT_DEFINITIONS: `precision highp sampler2D;\nprecision highp sampler3D;\n${this.sky.glsl}`,
            CUSTOM_FRAGMENT_BEFORE_FOG: `{
                vec3 way = vPositionW - skybake_camera, behind = ${behind};
                Air before = air(normalize(way), length(way));
                vec3 through = linear_srgb(before.through) / linear_srgb(before.through * 0.0 + 1.0);
                ${seen}.rgb = ${is_srgb ? `toGammaSpace(${all})` : all};
            }`};
    }
}

export class Skybake {
    static async load(folder, scene) {
        return new Skybake(await load_bake(folder, 'vec3(v.x, v.z, v.y)'), scene);
    }

    // `glsl` declares the uniforms, and has the functions that skybake.js lists.
    constructor({manifest, assets, glsl}, scene) {
        Object.assign(this, {manifest, glsl, scene, exposure: 12});
        this.textures = Object.fromEntries(assets.map((asset) => [asset.name, texture_of(asset, scene)]));
        this.set_sun(20, 0);
    }

    // Azimuths turn from +x towards +z.
    set_sun(elevation_degrees, azimuth_degrees) {
        this.sun = new Vector3(...sun_direction(elevation_degrees, azimuth_degrees, ([x, y, z]) => [x, z, y]));
    }

    // Gives a ShaderMaterial, or an effect, the textures and the numbers of the scene's camera.
    bind(material) {
        const camera = this.scene.activeCamera;
        for (const [name, texture] of Object.entries(this.textures)) material.setTexture(`${name}_table`, texture);
        material.setVector3('skybake_camera', camera.globalPosition);
        material.setVector3('skybake_sun', this.sun);
        material.setFloat('skybake_pixel', pixel_angle(camera.fov, this.scene.getEngine().getRenderHeight()));
        material.setFloat('skybake_exposure', this.exposure);
    }

    // A mesh that fills what nothing else covers with sky, ground and clouds. It writes sRGB.
    background() {
        Effect.ShadersStore.skybakeVertexShader = `attribute vec3 position;
            uniform mat4 rays;
            varying vec3 ray;
            void main() {
                ray = (rays * vec4(position, 1.0)).xyz;
                gl_Position = vec4(position.xy, 1.0, 1.0);
            }`;
        Effect.ShadersStore.skybakeFragmentShader = `precision highp float;\nprecision highp int;
            precision highp sampler2D;\nprecision highp sampler3D;\nvarying vec3 ray;\n${this.glsl}${picture_glsl}
            void main() { gl_FragColor = picture(normalize(ray)); }`;
        const material = new ShaderMaterial('skybake', this.scene, 'skybake', {attributes: ['position'],
            uniforms: ['rays', ...uniforms],
            samplers: Object.keys(this.textures).map((name) => `${name}_table`)});
        material.backFaceCulling = false;
        material.disableDepthWrite = true;
        const mesh = new Mesh('skybake', this.scene), triangle = new VertexData();
        Object.assign(triangle, {positions: [-1, -1, 1, 3, -1, 1, -1, 3, 1], indices: [0, 1, 2]});
        triangle.applyToMesh(mesh);
        mesh.alwaysSelectAsActiveMesh = true;
        mesh.isPickable = false;
        mesh.material = material;
        this.scene.onBeforeCameraRenderObservable.add((camera) => {
            const view = camera.getViewMatrix().getRotationMatrix();
            material.setMatrix('rays', camera.getProjectionMatrix().clone().invert().multiply(view.invert()));
            this.bind(material);
        });
        return mesh;
    }

    // Lets a material of Babylon.js lie behind the air: its own colour is dimmed, and the air's light is added.
    add_air(material) {
        new Air(material, this);
        return material;
    }
}
