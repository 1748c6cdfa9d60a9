// A level of detail: its voxels on demand, their statistics and probes. A volume may be larger than
// memory, so writers ask for it box by box, in the order of a BoxSequence.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bakers/field/image.h"

namespace skybake {

// Voxels origin ... origin + size - 1 along x, y, z.
struct VoxelBox {
    std::array<int, 3> origin{};
    std::array<int, 3> size{};
    std::int64_t count() const { return std::int64_t{size[0]} * size[1] * size[2]; }
};

// A pure function from voxel indices to values. Any thread may call it. An implementation may use
// scratch memory during a call but must not keep it between calls.
class VoxelSource {
  public:
    virtual ~VoxelSource() = default;
    // Writes channel c to channels[c]: box.count() floats, x fastest, then y, then z. A null
    // pointer means that the channel is not wanted. Values are as baked, before rounding to a pixel
    // type.
    virtual void fill(const VoxelBox& box, const std::vector<float*>& channels) const = 0;
    // Returns true only if every voxel of the box is known to be 0 in every channel without being
    // evaluated.
    virtual bool is_empty(const VoxelBox& /*box*/) const { return false; }
};

// Fills channels as VoxelSource::fill does, row after row: `row(c, y, z, out)` writes the box.size[0] voxels
// of channel c from box.origin[0] on.
template <class Row>
void fill_rows(const VoxelBox& box, const std::vector<float*>& channels, const Row& row) {
    for (std::size_t c = 0; c < channels.size(); ++c) {
        float* out = channels[c];
        if (out == nullptr) continue;
        for (int z = box.origin[2]; z < box.origin[2] + box.size[2]; ++z) {
            for (int y = box.origin[1]; y < box.origin[1] + box.size[1]; ++y, out += box.size[0]) {
                row(c, y, z, out);
            }
        }
    }
}

// A table's texels as stored, already rounded to the pixel type. Row y of the image is row y of the
// only slice.
class DenseTexels : public VoxelSource {
  public:
    explicit DenseTexels(Image2<float> image) : image_(std::move(image)) {}
    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override;
    const Image2<float>& image() const { return image_; }

  private:
    Image2<float> image_;
};

// Statistics of one channel as stored.
struct ValueStatistics {
    double min = 0;
    double max = 0;
    double mean = 0;
    std::array<double, 2> histogram_range{};  // the bins' outer bounds, [0, 1] for most noises
    std::vector<std::int64_t> histogram;      // bins of equal width; values outside are not counted
};

// A second lookup for a blended value: it has the weight `share`, the first lookup has the rest.
struct BlendedLookup {
    std::array<double, 3> uvw{};
    double share = 0;
};

// A place in a level and the value that a correct lookup of the stored file returns there.
struct Probe {
    std::vector<std::pair<std::string, double>> at = {};  // {"altitude_km", 0.5}, {"x_m", 500}
    std::array<double, 3> uvw{};    // texture coordinates: texel i is at (i + 1/2) / size; w of a
                                    // table is 1/2
    std::vector<double> value;      // one per channel, in double, as the level is looked up
    std::vector<double> tolerance;  // one per channel; allows filtering in steps of 1/256 texel
    std::vector<double> column_km = {};  // of tables of columns: what their lookups make of value
    std::optional<BlendedLookup> blend = {};  // of two sub-images, as in Bruneton's tables along nu
};

// A voxel whose value is large compared with its neighbours.
struct VoxelPeak {
    std::array<int, 3> voxel{};
    int channel = 0;
    float value = 0;
};

// Voxels whose first channel is not 0.
struct FilledVoxels {
    std::vector<std::array<int, 3>> some;  // every n-th, in the order of a BoxSequence
    double share = 1;                      // of all voxels
};

// One level of detail. Level 0 is the asset itself.
struct Level {
    std::array<int, 3> size{};                      // voxels along u, v, w; a table has one along w
    std::array<bool, 3> repeats{true, true, true};  // for lookups; other axes are clamped
    std::shared_ptr<const VoxelSource> voxels;
    std::shared_ptr<const VoxelSource> uncoded = {};  // before coding in blocks (block_voxels.h)
    std::vector<ValueStatistics> statistics;          // one per channel
    std::string content_hash;  // xxh3 of the voxels as stored, in x, y, z order, interleaved
    std::vector<Probe> probes;
    std::vector<std::string> catches;  // wrong lookups that the probes detect (wrong_lookups.h)
    bool nearest = false;              // lookups take the nearest voxel
    std::vector<VoxelPeak> peaks;      // large voxels; for the choice of probes
    FilledVoxels filled = {};          // where certificates look at sparse volumes
};

// The boxes that a volume is cut into, in the order in which a file needs its rows; they are made,
// converted and written one after the other. A group is `columns` slices: the cells of one row of
// an atlas, or one slice of a stack. Small groups share a box; large groups are cut into several
// boxes of whole rows. With columns = 1, the voxels of successive boxes are the volume's voxels in
// the order x, y, z. A box has at most kFloats values unless a single row of a group has more. The
// boxes are a pure function of the arguments, so sums over boxes are the same on every machine.
class BoxSequence {
  public:
    static constexpr std::int64_t kFloats = 1 << 21;  // 8 MiB

    BoxSequence(std::array<int, 3> size, int channels, int columns = 1);

    int count() const { return groups_ * parts_; }
    VoxelBox operator[](int index) const;
    // The number of voxels in the largest box.
    std::int64_t largest_count() const;

  private:
    std::array<int, 3> size_;
    int depth_ = 1;   // slices per box
    int rows_ = 1;    // rows per box
    int groups_ = 1;  // boxes along z
    int parts_ = 1;   // boxes along y
};

// How many boxes may be in memory while `threads` threads make them: enough to keep all threads
// busy, but at most 24, so that memory does not grow with the number of cores.
int box_slots(int threads);

}  // namespace skybake
