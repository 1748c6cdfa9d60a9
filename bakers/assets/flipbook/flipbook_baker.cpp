// The baker of asset = "flipbook": the frames of a sequence as layers of a texture, or as cells of a
// sheet.
//
// Layer k is frame k + 1 of the sequence, or a slice of it. A lookup between two layers blends two
// frames. The certificate says how far that is from the frames that a sequence of twice as many would
// have between them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "bakers/assets/flipbook/flipbook_sequence.h"
#include "bakers/assets/registry/baker.h"
#include "bakers/assets/registry/registry.h"
#include "bakers/field/baked.h"
#include "bakers/field/certify.h"
#include "bakers/field/finish_volume.h"
#include "bakers/field/pixel_type.h"
#include "config/assets/flipbook.h"
#include "config/sections/frames.h"

namespace skybake {

using config::FlipbookBake;
using config::FlipbookMapping;

namespace {

std::vector<AxisMapping> axes_of(const FlipbookSequence& sequence) {
    static constexpr std::array<const char*, 2> kQuantities = {"u", "v"};
    std::vector<AxisMapping> axes(3);
    for (std::size_t i = 0; i < 2; ++i) {
        axes[i].quantity = kQuantities[i];
        axes[i].formula = fmt::format("{0} = {0} of a frame", kQuantities[i]);
        axes[i].convention = "repeats; texel i is at (i + 1/2) / size";
        axes[i].last = 1;
    }
    const double frames = sequence.asset.length;
    axes[2].quantity = "frame";
    axes[2].formula = fmt::format("w = (frame + 1/2) / {}", frames);
    axes[2].convention = "layer k is frame k, counted from 0";
    axes[2].first = -0.5;
    axes[2].last = frames - 0.5;
    axes[2].constants = {{"offset", 0.5 / frames}, {"frames", frames}};
    for (AxisMapping& axis : axes) {
        axis.end_points = TexelConvention::end_points_on_edges;
        axis.wrap = AxisWrap::repeat;
    }
    if (!sequence.loops) axes[2].wrap = AxisWrap::clamp;
    return axes;
}

// Layers of an array that is no loop are looked up from the first to the last one.
ProbePlace place_of(const FlipbookSequence& sequence, std::array<double, 3> uvw) {
    const auto within = [](double x) { return x - std::floor(x); };
    const double frames = sequence.asset.length;
    const bool are_layers = sequence.asset.mapping == FlipbookMapping::layers;
    if (are_layers && !sequence.loops) uvw[2] = std::clamp(uvw[2], 0.5 / frames, 1 - 0.5 / frames);
    return {
        {{"u", within(uvw[0])}, {"v", within(uvw[1])}, {"frame", within(uvw[2]) * frames - 0.5}},
        {{uvw}}};
}

double range_of_values(const Baked& volume) {
    double low = 0;
    double high = 0;
    for (const ValueStatistics& channel : volume.levels.front().statistics) {
        low = std::min(low, channel.min);
        high = std::max(high, channel.max);
    }
    return high > low ? high - low : 1;
}

// Compares stored layers with the frames that they hold, and blends of two layers with frames that
// were baked between them.
class FlipbookErrors {
  public:
    FlipbookErrors(const FlipbookSequence& sequence, const Baked& volume)
        : sequence_(sequence), volume_(volume), range_(range_of_values(volume)) {}

    // Returns false once interrupted.
    bool measure(int frame) {
        const std::array<int, 3> size = sequence_.size();
        const int next = (frame + 1) % size[2];
        const std::size_t channels = volume_.channel_names.size();
        const Layer stored = stored_layer(frame);
        const VoxelBox box{{0, 0, sequence_.asset.slice}, {size[0], size[1], 1}};
        compare(stored, stored,
                layer_of(*sequence_.voxels[static_cast<std::size_t>(frame)], box, channels),
                texel_);
        if (next == 0 && !sequence_.loops) return true;
        const Outcome<Baked> between =
            make_frame(config::after_frame(sequence_.parameters, frame + 1), sequence_.first,
                       sequence_.options);
        if (!between.value) return false;
        compare(stored, stored_layer(next),
                layer_of(*between.value->levels.front().voxels, box, channels), lookup_);
        return true;
    }

    Certificate certificate() const {
        Certificate result;
        result.texel = texel_.figures();
        result.lookup = lookup_.figures();
        result.texel_points = static_cast<int>(texel_.count());
        result.lookup_points = static_cast<int>(lookup_.count());
        result.reference =
            "texels: the frames; lookups: the middle of two layers against the frame between them, "
            "baked with twice as many frames";
        result.scale = "range of all values";
        return result;
    }

  private:
    Layer stored_layer(int frame) const {
        const std::array<int, 3> size = sequence_.size();
        Layer values =
            layer_of(*volume_.levels.front().voxels, {{0, 0, frame}, {size[0], size[1], 1}},
                     volume_.channel_names.size());
        if (!config::is_block_coded(volume_.pixel_type)) {
            round_values(values.data(), values.size(), volume_.pixel_type);
        }
        return values;
    }

    void compare(const Layer& a, const Layer& b, const Layer& wanted, ErrorStatistics& errors) {
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            errors.add((0.5 * (double{a[i]} + double{b[i]}) - double{wanted[i]}) / range_);
        }
    }

    const FlipbookSequence& sequence_;
    const Baked& volume_;
    double range_;
    ErrorStatistics texel_;
    ErrorStatistics lookup_;
};

// Returns the frames that are measured: all, or some in steps of the golden ratio, which keep clear of
// the steps in which noise moves.
std::vector<int> measured_frames(int length, Certification certification) {
    constexpr int kQuick = 8;
    constexpr double kGoldenRatio = 0.6180339887498949;
    std::vector<int> frames;
    const bool all = certification == Certification::full || length <= kQuick;
    for (int i = 0; i < (all ? length : kQuick); ++i) {
        const double turns = i * kGoldenRatio;
        frames.push_back(all ? i : static_cast<int>((turns - std::floor(turns)) * length));
    }
    return frames;
}

Certificate certificate_of(const FlipbookSequence& sequence, const Baked& volume) {
    FlipbookErrors errors(sequence, volume);
    for (const int frame : measured_frames(sequence.asset.length, sequence.options.certification)) {
        if (!errors.measure(frame)) break;
    }
    return errors.certificate();
}

// Fills all of `volume` except its name and parameters. Returns what the baker of the frames reports,
// E0401 or E0402 for a texel that the pixel type cannot hold, and neither value nor diagnostics after an
// interruption.
Outcome<Baked> bake_flipbook(const Parameters& parameters, const FlipbookBake& bake,
                             const BakeOptions& options, Baked volume) {
    FlipbookSequence sequence{parameters, config::first_frame(parameters, bake), bake, options};
    std::vector<Diagnostic> problems = sequence.read();
    if (!problems.empty()) return {{}, std::move(problems)};
    if (options.cancelled()) return {};
    const Baked& frame = sequence.kind;
    volume.kind = "flipbook";
    volume.content = fmt::format("{} frames: {}", bake.length, frame.content);
    volume.mapping = bake.mapping == FlipbookMapping::layers ? "layers" : "frames";
    volume.axes = axes_of(sequence);
    volume.channel_names = frame.channel_names;
    set_files(bake, volume);
    volume.voxel_size_m.fill(1.0 / frame.levels.front().size[0]);  // a frame is a metre wide
    volume.up_axis = "+z";
    volume.details.emplace_back("frames", static_cast<double>(bake.length));
    volume.details.emplace_back("loops", sequence.loops ? "yes" : "no");
    add_voxels(sequence.size(), std::make_shared<const FrameVoxels>(sequence.voxels, bake.slice),
               volume);
    hold_voxels(options, volume);
    add_slice_levels(bake.mips, options, volume);
    return finish_volume(
        std::move(volume),
        {.histogram_ranges = sequence.usual_ranges(),
         .measure = [&sequence](const Baked& baked,
                                const BakeOptions&) { return certificate_of(sequence, baked); },
         .probe_place = [&sequence](const std::array<double, 3>& uvw,
                                    int) { return place_of(sequence, uvw); }},
        options);
}

Outcome<Baked> bake(const Parameters& parameters, const FlipbookBake& asset,
                    const BakeOptions& options, AssetLabel label) {
    return bake_flipbook(parameters, asset, options, labelled_volume(std::move(label)));
}

Estimate estimate(const Parameters& parameters, const FlipbookBake& asset) {
    constexpr std::size_t kMostChannels = 4;
    const Bake& first = config::first_frame(parameters, asset);
    const auto [width, height, depth] = config::frame_size(first);
    Estimate result = estimate_volume(asset, {width, height, asset.length}, kMostChannels, 1e-9);
    result.seconds += asset.length * baker_of(first).estimate(parameters, first).seconds;
    return result;
}

AssetPlaces places(const Parameters&, const FlipbookBake& asset, const StoredTexels&) {
    return single_lookup({"u", "v", "frame"}, [frames = asset.length](const Place& at) {
        return Uvw{at[0].second, at[1].second, (at[2].second + 0.5) / frames};
    });
}

AssetLookup lookup(const Parameters&, const FlipbookBake& asset, const StoredTexels& stored) {
    const bool are_layers = asset.mapping == config::FlipbookMapping::layers;
    GlslFunction function;
    function.comment =
        "Returns the channels at u and v of a frame, counted from 0; between two numbers the two "
        "frames are blended. All may be any numbers, as frames repeat.";
    function.arguments = fmt::format("{} table, float u, float v, float frame",
                                     are_layers ? "sampler2DArray" : "sampler3D");
    function.value = fmt::format("flipbook{}(table, {}, vec2(u, v), frame)",
                                 are_layers ? "_layers" : "", glsl_number(stored.size[2]));
    return {"flipbook", {with_channels(stored.channels, 4, std::move(function))}};
}

std::vector<InputFile> inputs(const Parameters& parameters, const FlipbookBake& asset) {
    const Bake& first = config::first_frame(parameters, asset);
    return baker_of(first).inputs(parameters, first);
}

}  // namespace

Baker<FlipbookBake> baker(BakerTag<FlipbookBake>) {
    return {.version = 2,
            .bake = bake,
            .estimate = estimate,
            .places = places,
            .lookup = lookup,
            .inputs = inputs};
}

}  // namespace skybake
