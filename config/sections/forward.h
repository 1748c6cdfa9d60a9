// This header declares the sections of a recipe for who only hands them on, so that a key of one
// concerns few sources. Each is defined in a header of its own.
#pragma once

namespace skybake::config {

struct AssetFiles;
struct Atmosphere;
struct Bake;
struct Cloud;
struct Layer;
struct Noise;
struct NoiseChannel;
struct Parameters;
struct Particles;
struct VolumeFile;

enum class CloudParticles;
enum class Compression;
enum class FileFormat;
enum class Ktx2Compression;
enum class Phase;
enum class SheetLayout;
enum class Target;
enum class VdbCompression;

}  // namespace skybake::config

namespace skybake {

// Every room speaks of these.
using config::Bake;
using config::Cloud;
using config::Noise;
using config::Parameters;

}  // namespace skybake
