// Shared by lit pictures of clouds: the light, the medium with its leaps, and words of captions.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "bakers/assets/cloud_light/march_light.h"
#include "bakers/preview/picture_light.h"
#include "bakers/preview/pictures/cloud_pictures.h"
#include "bakers/render/scene_view.h"

namespace skybake {

// An atmosphere and its tables, and who makes its solved skies.
struct Lighting {
    SkyMedium medium;
    SkyTables tables;
    std::string name;             // as captions say it
    const Recipe* air = nullptr;  // null: the preset "earth"
    std::shared_ptr<PictureLight> light;
};

// Returns the light of the input's atmosphere or, if that is not complete, of the preset "earth".
// Returns nothing if make_sky_tables (sky_tables.h) refuses the tables.
std::optional<Lighting> lighting_of(const CloudPreviewInput& input, int threads);

// Returns the solved sky that the camera of a picture sees; nothing if the light cannot be solved for.
std::optional<SolvedSky> solved_sky(const CloudPreviewInput& input, const Lighting& lighting,
                                    const CloudCamera& camera, const SunDirection& sun,
                                    int threads);

// Returns the light within a cloud of the picture, from which that under each sun follows; nothing where
// pictures are those of a runtime that has tables alone.
std::optional<cloud_light::MarchLight> light_within(const CloudPreviewInput& input,
                                                    const CloudMedium& medium,
                                                    const BakeOptions& options);

// Returns that light under a sun; nothing if there is none, if none was found, or if the layer does not see the sun.
std::optional<LightInCloud> light_under(const std::optional<cloud_light::MarchLight>& within,
                                        const Lighting& lighting, const CloudMedium& medium,
                                        const SunDirection& sun, const BakeOptions& options);

// Returns the words of captions about that light.
std::string light_text(const std::optional<LightInCloud>& light);

// Returns the words of captions about the sky behind clouds.
std::string sky_text(const std::optional<SolvedSky>& solved);

// Returns the cloud with the extent of its volume.
std::optional<Cloud> cloud_as_baked(const CloudPreviewInput& input);

// The words of captions about copies of tiles that vary.
inline constexpr const char* kCopiesText =
    "Each copy of a tile but the first begins at another voxel, and neighbours overlap by an "
    "eighth of their edge, so that no pattern repeats.";

// A medium with its leaps, and where they come from. The copies of a medium that repeats vary.
struct LeapingMedium {
    CloudMedium medium;
    std::string leaps_name;  // as captions say it
};
LeapingMedium leaping_medium(const CloudPreviewInput& input, const Cloud& cloud, bool repeats,
                             int threads);

// Returns the size of lit pictures, which is half as large in a draft.
std::array<int, 2> drawn_size(const CloudPreviewInput& input);

// Returns how a lit picture of this size is marched.
SceneFrame frame_of(const CloudCamera& camera, int width, int height);

// Returns the title of the picture of one of the input's suns, and the end of the file's name.
std::string sun_words(const CloudPreviewInput& input, const SunDirection& sun);
std::string sun_name(const CloudPreviewInput& input, const SunDirection& sun);

// Returns how many rays pixels have, as part of a caption.
std::string samples_text(const SceneFrame& frame, int refined_pixels);

// Says where the sun is for somebody who looks along the camera's heading.
std::string beside_view(const SunDirection& sun, const CloudCamera& camera);

}  // namespace skybake
