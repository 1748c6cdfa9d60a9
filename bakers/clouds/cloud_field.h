// A cloud over its voxels, computed on demand. Bounds of profile, towers, coverage and noise prove
// regions empty, and no noise is computed there, so that the time depends on the cloud and not on
// its box.
#pragma once

#include <vector>

#include "bakers/clouds/cloud_plan.h"
#include "bakers/clouds/column_field.h"
#include "bakers/field/level.h"

namespace skybake::cloud {

class CloudField : public VoxelSource {
  public:
    explicit CloudField(CloudPlan plan);
    void fill(const VoxelBox& box, const std::vector<float*>& channels) const override;
    bool is_empty(const VoxelBox& box) const override;
    const CloudPlan& plan() const { return plan_; }

  private:
    CloudPlan plan_;
    Columns columns_;  // all columns, or none if there are too many to keep
};

// Fills a box with the cloud of these columns, or of the plan's own where `columns` holds none.
void fill_cloud(const CloudPlan& plan, const Columns& columns, const VoxelBox& box,
                const std::vector<float*>& channels);

}  // namespace skybake::cloud
