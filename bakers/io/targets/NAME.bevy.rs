//! Loads $FILE$ into Bevy with the sampler that its lookups need: copy the file into `assets` and this module
//! into `src`, and call `load`. The features `ktx2` and `bevy_pbr` are needed, and `zstd_rust` for Zstandard.
use bevy::image::{ImageAddressMode, ImageFilterMode, ImageLoaderSettings, ImageSampler, ImageSamplerDescriptor};
use bevy::prelude::*;

$if PARTS=none$/// A texture of $WIDTH$ x $HEIGHT$ x $DEPTH$ texels of type $TYPE$.
$if PARTS=cube$/// A cube texture of type $TYPE$ with faces of $WIDTH$ x $WIDTH$ texels.
pub fn load(assets: &AssetServer) -> Handle<Image> {
    assets.load_with_settings("$FILE$", |settings: &mut ImageLoaderSettings| {
        settings.is_srgb = false;
        settings.sampler = ImageSampler::Descriptor(ImageSamplerDescriptor {
$if WRAP_U=repeat$            address_mode_u: ImageAddressMode::Repeat,
$if WRAP_U=clamp$            address_mode_u: ImageAddressMode::ClampToEdge,
$if WRAP_V=repeat$            address_mode_v: ImageAddressMode::Repeat,
$if WRAP_V=clamp$            address_mode_v: ImageAddressMode::ClampToEdge,
$if WRAP_W=repeat$            address_mode_w: ImageAddressMode::Repeat,
$if WRAP_W=clamp$            address_mode_w: ImageAddressMode::ClampToEdge,
$if FILTER=linear$            mag_filter: ImageFilterMode::Linear,
$if FILTER=linear$            min_filter: ImageFilterMode::Linear,
$if FILTER=nearest$            mag_filter: ImageFilterMode::Nearest,
$if FILTER=nearest$            min_filter: ImageFilterMode::Nearest,
            ..default()
        });
    })
}
$if KIND=phase$
$if KIND=phase$/// The phase function for a `ScatteringTerm` of Bevy 0.19 or later.
$if KIND=phase$pub fn phase(assets: &AssetServer) -> bevy::light::atmosphere::PhaseFunction {
$if KIND=phase$    bevy::light::atmosphere::PhaseFunction::from_chromatic_texture(load(assets))
$if KIND=phase$}
$if KIND=cloud_volume$
$if KIND=cloud_volume$/// The cloud as fog, in metres, with its place: Bevy's y points up, the file's z does.
$if KIND=cloud_volume$pub fn fog(assets: &AssetServer) -> (bevy::light::FogVolume, Transform) {
$if KIND=cloud_volume$    let volume = bevy::light::FogVolume {
$if KIND=cloud_volume$        density_texture: Some(load(assets)),
$if KIND=cloud_volume$        density_factor: $EXTINCTION$ as f32,
$if KIND=cloud_volume$        absorption: 0.0,
$if KIND=cloud_volume$        ..default()
$if KIND=cloud_volume$    };
$if KIND=cloud_volume$    let place = Transform::from_xyz($CENTER_X$ as f32, $CENTER_Z$ as f32, -$CENTER_Y$ as f32)
$if KIND=cloud_volume$        .with_rotation(Quat::from_rotation_x(-std::f32::consts::FRAC_PI_2))
$if KIND=cloud_volume$        .with_scale(Vec3::new($EXTENT_X$ as f32, $EXTENT_Y$ as f32, $EXTENT_Z$ as f32));
$if KIND=cloud_volume$    (volume, place)
$if KIND=cloud_volume$}
$if PARTS=cube$
$if PARTS=cube$/// The sky for a `Camera3d`: straight ahead is -z, up +y and right +x. `illuminance` is that of a surface that faces
$if PARTS=cube$/// the sun outside of the air, in lux: the texels are radiances for a solar irradiance of 1.
$if PARTS=cube$pub fn skybox(assets: &AssetServer, illuminance: f32) -> bevy::core_pipeline::Skybox {
$if PARTS=cube$    bevy::core_pipeline::Skybox { image: load(assets), brightness: illuminance, ..default() }
$if PARTS=cube$}
