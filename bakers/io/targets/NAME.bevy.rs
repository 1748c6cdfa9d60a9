//! Loads $FILE$ into Bevy with the sampler that its lookups need: copy the file into `assets` and this module
//! into `src`, and call `load`. It is for Bevy 0.19 and later, with the features `ktx2` and
//! `bevy_pbr`, and `zstd_rust` for Zstandard.
use bevy::image::{ImageAddressMode, ImageFilterMode, ImageLoaderSettings, ImageSampler, ImageSamplerDescriptor};
use bevy::prelude::*;

$if PLAYS=yes$pub const FRAMES: u32 = $FRAMES$;
$if PLAYS=yes$pub const FRAMES_PER_SECOND: f32 = $RATE$ as f32;
$if PLAYS=yes$
$if PLAYS=yes$/// Frame n is counted from 1 to `FRAMES`; load all when the scene begins.
$if PARTS=none$/// A texture of $WIDTH$ x $HEIGHT$ x $DEPTH$ texels of type $TYPE$.
$if PARTS=cube$/// A cube texture of type $TYPE$ with faces of $WIDTH$ x $WIDTH$ texels.
$if PLAYS=no$pub fn load(assets: &AssetServer) -> Handle<Image> {
$if PLAYS=yes$pub fn load(assets: &AssetServer, frame: u32) -> Handle<Image> {
$if PLAYS=no$    assets.load_with_settings("$FILE$", |settings: &mut ImageLoaderSettings| {
$if PLAYS=yes$    let file = format!("$NAME$_{frame:0$DIGITS$}$ENDING$");
$if PLAYS=yes$    assets.load_with_settings(file, |settings: &mut ImageLoaderSettings| {
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
$if KIND=phase$/// The phase function for a `ScatteringTerm`.
$if KIND=phase$pub fn phase(assets: &AssetServer) -> bevy::light::atmosphere::PhaseFunction {
$if KIND=phase$    bevy::light::atmosphere::PhaseFunction::from_chromatic_texture(load(assets))
$if KIND=phase$}
$if KIND=cloud_volume$
$if KIND=cloud_volume$/// The cloud as fog, in metres, with its place: Bevy's y points up, the file's z does.
$if KIND=cloud_volume$$if PLAYS=no$pub fn fog(assets: &AssetServer) -> (bevy::light::FogVolume, Transform) {
$if KIND=cloud_volume$$if PLAYS=yes$pub fn fog(assets: &AssetServer, frame: u32) -> (bevy::light::FogVolume, Transform) {
$if KIND=cloud_volume$    let volume = bevy::light::FogVolume {
$if KIND=cloud_volume$$if PLAYS=no$        density_texture: Some(load(assets)),
$if KIND=cloud_volume$$if PLAYS=yes$        density_texture: Some(load(assets, frame)),
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
$if PARTS=cube$pub fn skybox(assets: &AssetServer, illuminance: f32) -> bevy::light::Skybox {
$if PARTS=cube$    bevy::light::Skybox { image: load(assets).into(), brightness: illuminance, ..default() }
$if PARTS=cube$}
$if LAMP=yes$
$if LAMP=yes$/// The sun, which the cube lacks, for the same `illuminance`.
$if LAMP=yes$pub fn sunlight(illuminance: f32) -> (DirectionalLight, Transform) {
$if LAMP=yes$    let light = DirectionalLight {
$if LAMP=yes$        color: Color::linear_rgb($SUN_R$ as f32, $SUN_G$ as f32, $SUN_B$ as f32),
$if LAMP=yes$        illuminance: illuminance * $IRRADIANCE$ as f32,
$if LAMP=yes$        ..default()
$if LAMP=yes$    };
$if LAMP=yes$    let to_sun = Vec3::new($SUN_RIGHT$ as f32, $SUN_UP$ as f32, -($SUN_AHEAD$) as f32);
$if LAMP=yes$    (light, Transform::default().looking_to(-to_sun, Vec3::Y))
$if LAMP=yes$}
