// Recipes that have every key of every section between them, with assets that bake in milliseconds.
#pragma once

namespace skybake {

inline constexpr const char* kSky = R"(
preset = "earth_hillaire"
[scene]
altitude = ["0 km", "2 km"]
sun_elevation = ["-5 deg", "80 deg"]
view_distance = "20 km"
[particles.drop]
material = "constant"
refractive_index = 1.33
absorption_index = 0.001
sizes = "log_normal"
radius = "0.3 um"
geometric_deviation = 1.5
[atmosphere.layers.fog]
profile = "slab"
bottom_altitude = "0 m"
top_altitude = "100 m"
phase = { mie = "drop" }
number_density = "15 /cm3"
[bake.transmittance]
size = [4, 4]
[bake.scattered]
asset = "multiple_scattering"
method = "converged"
mapping = "hillaire"
size = [2, 2]
[bake.solved]
asset = "multiple_scattering"
method = "solved"
size = [2, 2]
[bake.view]
asset = "sky_view"
orders = "single"
size = [4, 4]
sun_elevations = ["20 deg"]
[bake.around]
asset = "environment"
orders = "single"
size = [8, 8]
mips = 2
sun_elevation = "20 deg"
solar_irradiance = 2
[bake.spheres]
asset = "phase"
particles = "drop"
size = 16
[bake.of_layer]
asset = "phase"
layer = "mie"
size = 16
[bake.columns]
asset = "optical_depth"
size = [4, 4, 1]
[bake.bruneton]
asset = "bruneton"
table = "transmittance"
size = [4, 4, 1]
)";

inline constexpr const char* kClouds = R"(
preset = "earth_hillaire"
[noise.shape]
seed = 3
[noise.shape.channels.R]
type = "perlin_worley"
frequency = 2
octaves = 2
worley_frequency = 2
worley_octaves = 1
[noise.shape.channels.G]
type = "worley"
frequency = 3
[noise.shape.channels.B]
type = "worley"
frequency = 4
[noise.shape.channels.A]
type = "worley"
frequency = 5
[noise.detail.channels.Y]
type = "perlin"
frequency = 3
fractal = "ridged"
[noise.curls.channels.Y]
type = "curl"
frequency = 2
component = "x"
[noise.curl_vector.channels.R]
type = "curl"
frequency = 2
component = "x"
[noise.curl_vector.channels.G]
type = "curl"
frequency = 2
component = "y"
[noise.curl_vector.channels.B]
type = "curl"
frequency = 2
component = "z"
[clouds.c]
corner = ["20 m", "-30 m"]
noise = "shape"
detail = "detail"
erosion = [0.1, 0.2]
extent = ["1 km", "1 km", "1 km"]
coverage = 0.8
threshold = 0.1
height_profile = { type = "blended", cloud_type = 0.4 }
[clouds.c.scatter]
count = 3
seed = 5
sigma = [0.1, 0.3]
[[clouds.c.towers]]
center = [0.5, 0.4]
sigma = [0.3, 0.25]
rotation = "30 deg"
amplitude = 0.3
[bake.transmittance]
size = [4, 4]
[bake.noise]
asset = "noise_volume"
noise = "shape"
size = [8, 8, 8]
[bake.curl]
asset = "noise_volume"
noise = "curls"
size = [8, 8, 8]
[bake.map]
asset = "weather_map"
noise = "curl_vector"
size = [17, 13]
[bake.mask]
asset = "blue_noise"
size = [8, 8]
frames = 4
[bake.cloud]
asset = "cloud_volume"
cloud = "c"
size = [8, 8, 8]
[bake.cells]
asset = "occupancy"
of = "cloud"
cell = 2
[bake.light]
asset = "cloud_light"
of = "cloud"
sun_elevations = ["40 deg"]
sun_azimuths = ["20 deg"]
[bake.sky]
asset = "cloud_light"
of = "cloud"
contents = "sky_visibility"
degree = 2
[bake.near_light]
asset = "cloud_light"
of = "cloud"
sun_elevations = ["40 deg"]
max_error = "20 %"
[bake.radiance]
asset = "cloud_light"
of = "cloud"
contents = "sun_radiance"
sun_elevations = ["40 deg"]
degree = 2
[bake.distance]
asset = "cloud_distance"
of = "cloud"
cell = 2
range = ["-64 m", "1024 m"]
core = "100 m"
contents = ["distance", "profile", "detail_type", "density_scale"]
)";

// Apart from other clouds, since whatever does not change an environment has it made anew.
inline constexpr const char* kCloudySky = R"(
preset = "earth_hillaire"
[noise.n.channels.Y]
type = "worley"
frequency = 2
[clouds.c]
noise = "n"
extent = ["400 m", "400 m", "200 m"]
base_altitude = "500 m"
corner = ["20 m", "-30 m"]
extinction_scale = "20 /km"
[bake.cloud]
asset = "cloud_volume"
cloud = "c"
size = [4, 4, 4]
[bake.sky_light]
asset = "cloud_light"
of = "cloud"
contents = "clear_sky_radiance"
sun_elevations = ["40 deg"]
sun_azimuths = ["20 deg"]
[bake.cloudy]
asset = "environment"
orders = "single"
clouds = "cloud"
size = [8, 8]
mips = 2
sun_elevation = "20 deg"
)";

inline constexpr const char* kParticles = R"(
preset = "earth_hillaire"
[particles.gamma]
sizes = "gamma"
effective_radius = "0.1 um"
effective_variance = 0.05
[particles.modified]
sizes = "modified_gamma"
radius = "0.1 um"
alpha = 6
gamma = 1.5
[bake.gamma]
asset = "phase"
particles = "gamma"
size = 16
[bake.modified]
asset = "phase"
particles = "modified"
size = 16
)";

// Gases, aerosols and colours.
inline constexpr const char* kColors = R"(
wavelengths = ["446 nm", "525 nm", "576 nm", "637 nm"]
[color]
space = "linear_srgb"
observer = "cie_1931"
sun = "measured"
white = "sun"
[atmosphere]
ground_radius = "6372 km"
top_radius = "6472 km"
ground_albedo = [["440 nm", 0.1], ["680 nm", 0.3]]
[atmosphere.layers.air]
gas = "air"
pressure = "840 hPa"
depolarization = 0.03
profile = "exponential"
scale_height = "8 km"
phase = "rayleigh"
[atmosphere.layers.ozone]
gas = "ozone"
column = "300 DU"
profile = "tent"
center_altitude = "22 km"
half_width = "19 km"
[atmosphere.layers.haze]
optical_depth = 0.04
angstrom_exponent = 1.4
single_scattering_albedo = 0.96
profile = "exponential"
scale_height = "1.5 km"
phase = "isotropic"
[atmosphere.layers.mist]
visibility = "40 km"
profile = "exponential"
scale_height = "0.5 km"
phase = "isotropic"
[bake.transmittance]
size = [4, 4]
[bake.light]
asset = "irradiance"
content = "direct"
size = [4, 4]
)";

// Volumes of every format (tests/data/volumes).
inline constexpr const char* kVolumes = R"(
[volumes.grid]
file = "../volumes/python.vdb"
grid = "density"
voxel_size = ["20 m", "10 m", "30 m"]
crop_corner = ["-25 m", "5 m", "150 m"]
crop_extent = ["60 m", "20 m", "60 m"]
up_axis = "y"
wrap = "repeat"
not_finite = "refuse"
[volumes.numbers]
file = "../volumes/numbers.raw"
format = "raw"
size = [4, 3, 2]
type = "float32"
byte_order = "little"
axis_order = "xyz"
offset = 0
voxel_size = ["10 m", "10 m", "10 m"]
crop_first = [1, 0, 0]
crop_size = [3, 2, 2]
border = 1
[volumes.pictures]
file = "../volumes/slice_%d.png"
format = "slices"
channel = ""
first_slice = 1
slices = 2
voxel_size = ["10 m", "10 m", "10 m"]
scale = 0.5
[clouds.of_grid]
volume = "grid"
extent = ["100 m", "60 m", "40 m"]
[clouds.of_numbers]
volume = "numbers"
extent = ["100 m", "60 m", "40 m"]
threshold = 0.2
[clouds.of_pictures]
volume = "pictures"
extent = ["100 m", "60 m", "40 m"]
edge_softness = 0.1
[bake.of_grid]
asset = "cloud_volume"
cloud = "of_grid"
size = [6, 5, 4]
[bake.of_numbers]
asset = "cloud_volume"
cloud = "of_numbers"
size = [6, 5, 4]
[bake.of_pictures]
asset = "cloud_volume"
cloud = "of_pictures"
size = [6, 5, 4]
)";

// Choices that those before leave out: other kinds of layers, channels and profiles, and maps.
inline constexpr const char* kOthers = R"(
preset = "earth_hillaire"
[atmosphere.layers.dust]
enabled = true
profile = "tabulated"
table = [["0 km", 1.0], ["5 km", 0.5], ["9 km", 0.0]]
scattering = "1e-6 /m"
single_scattering_albedo = 0.9
phase = "henyey_greenstein"
g = 0.7
[particles.grit]
material = "tabulated"
indices = [["400 nm", 1.5, 0.01], ["720 nm", 1.52, 0.004]]
effective_radius = "0.3 um"
smallest_radius = "0.1 um"
largest_radius = "0.7 um"
[atmosphere.layers.smoke]
profile = "exponential"
scale_height = "2 km"
aerosol = "continental_average"
relative_humidity = 0.7
[atmosphere.layers.smoke_and_grit]
profile = "exponential"
scale_height = "1 km"
components = [["soot", "100 /cm3"], ["grit", "2 /cm3"]]
optical_depth = 0.01
[noise.shape.channels.Y]
type = "worley"
frequency = 2
octaves = 2
gain = 0.5
lacunarity = 2
clamp = [0.1, 0.9]
smoothstep = [0.2, 0.8]
[noise.mixed.channels.R]
type = "perlin_worley"
frequency = 2
worley_frequency = 2
worley_octaves = 2
worley_gain = 0.5
worley_lacunarity = 2
[noise.mixed.channels.G]
type = "constant"
value = 0.3
[noise.mixed.channels.B]
type = "constant"
value = 0.6
[noise.moving]
period = 6
time = 1
time_cells = 2
drift = [1, 0, 0]
[noise.moving.channels.Y]
type = "curly_alligator"
frequency = 2
warp_strength = 0.2
warp_by = "gradient"
warp_frequency = 2
warp_octaves = 2
warp_lacunarity = 2
warp_gain = 0.5
[bake.moving]
asset = "noise_volume"
noise = "moving"
size = [8, 8, 8]
frame = 2
[bake.wave]
asset = "noise_volume"
noise = "moving"
size = [8, 8, 4]
frames = 2
frames_per_second = 12
formats = ["vdb", "usda"]
[bake.forward]
asset = "forward_scattering"
size = [8, 6]
degree = 2
droplet_diameter = "10 um"
single_scattering_albedo = 0.9
[bake.book]
asset = "flipbook"
of = "wave"
length = 2
slice = 1
[clouds.living]
noise = "moving"
extent = ["1 km", "1 km", "1 km"]
period = 6
time = 1
drift = [0.3, 0.2]
shear = [0.4, 0.1]
[clouds.living.scatter]
count = 3
sigma = [0.1, 0.3]
life = [0.4, 0.3, 0.2]
grows_from = 0.5
[[clouds.living.towers]]
shape = "dome"
foot = ["500 m", "400 m", "0 m"]
size = ["700 m", "600 m", "800 m"]
amplitude = 1
life = [0.3, 0.2, 0.4]
grows_from = 0.3
born = 0.1
[bake.living]
asset = "cloud_volume"
cloud = "living"
size = [8, 8, 8]
frame = 2
[clouds.mapped]
noise = "shape"
extent = ["1 km", "1 km", "1 km"]
coverage = 0.9
full_at = 0.5
height_profile = { type = "tabulated", table = [[0, 0.5], [0.5, 1], [1, 0.2]] }
coverage_map = { file = "grey16.png", channel = "R" }
[clouds.typed]
noise = "shape"
extent = ["1 km", "1 km", "1 km"]
height_profile = { type = "blended" }
type_map = { file = "rgba8.png", channel = "G" }
[clouds.of_thesis]
noise = "shape"
extent = ["1 km", "1 km", "1 km"]
height_profile = { type = "thesis", bottom_sharpness = 40, top_falloff = 3 }
[clouds.of_thesis.scatter]
shape = "dome"
count = 2
width = ["200 m", "300 m"]
lobes = 3
[[clouds.of_thesis.towers]]
shape = "dome"
foot = ["400 m", "500 m", "10 m"]
size = ["500 m", "400 m", "600 m"]
widest = 0.2
lean = [0.1, 0.2]
lobes = 4
lobe_size = [0.2, 0.4]
seed = 3
amplitude = 0.8
[bake.transmittance]
size = [4, 4]
[bake.mixed]
asset = "noise_volume"
noise = "mixed"
size = [8, 8, 8]
[bake.mapped]
asset = "cloud_volume"
cloud = "mapped"
size = [8, 8, 8]
[bake.typed]
asset = "cloud_volume"
cloud = "typed"
size = [8, 8, 8]
[bake.of_thesis]
asset = "cloud_volume"
cloud = "of_thesis"
size = [8, 8, 8]
)";

}  // namespace skybake
