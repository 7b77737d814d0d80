// SPDX-License-Identifier: MIT
// The map, and how points find planes in it.
#include "core/config/options/bind_options.h"
#include "core/config/options/option_binder.h"

namespace trajlo {
namespace {

const Names<MapKind> kMapKinds = {{"voxel_hash", MapKind::kVoxelHash},
                                  {"kd_tree", MapKind::kKdTree}};

}  // namespace

void BindMap(MapPyramidOptions* pyramid, OptionBinder* b) {
  MapOptions* map = &pyramid->finest;
  b->Add("map.kind", map->kind, kMapKinds,
         "voxel_hash is fast; kd_tree finds the exact neighbours.");
  b->Add("map.voxel_size_m", map->voxel_size_m, Range<double>{1e-2, 20.0},
         "Edge of a voxel (paper: 0.4 m indoors, 0.8 m outdoors).");
  b->Add("map.min_point_spacing_m", map->min_point_spacing_m, Range<double>{0.0, 10.0},
         "A point nearer than this to another of its voxel is not added: otherwise a sensor at "
         "rest fills the voxels with copies of the same rings.");
  b->Add("map.radius_m", map->radius_m, Range<double>{1.0, 1e4},
         "Voxels farther than this from the sensor are dropped.");
  b->Add("map.levels", pyramid->levels, Range<int>{1, 8},
         "Maps of growing coarseness, each with voxels and spacing twice those of the one before.");
  b->Add("map.shared_planes", map->shared_planes,
         "One plane for each eighth of a voxel, kept until the points around it have become more; "
         "false fits one for every point, as the paper does.");

  PlaneFitOptions& plane = pyramid->plane;
  b->Add("map.plane.neighbors", plane.neighbors, Range<int>{3, kMaxNeighbors},
         "Map points taken for a plane (paper: 5).");
  b->Add("map.plane.min_neighbors", plane.min_neighbors, Range<int>{3, kMaxNeighbors},
         "Fewer make no plane.");
  b->Add("map.plane.max_thickness_m", plane.max_thickness_m, Range<double>{1e-4, 10.0},
         "Upper bound of the neighbours' standard deviation across the plane.");
  b->Add("map.plane.min_width_in_spacings", plane.min_width_in_spacings, Range<double>{0.0, 10.0},
         "Lower bound of their standard deviation along the plane's shorter axis, in spacings of "
         "the map's points: neighbours on one scan line have no normal.");
  b->Add("map.plane.max_flatness", plane.max_flatness, Range<double>{1e-3, 1.0},
         "Upper bound of the ratio of the first to the second.");
  b->Add("map.plane.min_incidence_sine", plane.min_incidence_sine, Range<double>{0.0, 0.9},
         "Planes that meet the ray to the point at a smaller angle than this sine's are taken only "
         "where there is no other: a plane through the sensor is mostly a scan line, no surface.");
  b->Add("map.plane.max_wide_flatness", plane.max_wide_flatness, Range<double>{0.0, 1.0},
         "A plane of a coarser level that is at most so flat, and thin, is preferred to those of "
         "the finer ones (0: never) ...");
  b->Add("map.plane.max_wide_distance_in_widths", plane.max_wide_distance_in_widths,
         Range<double>{0.0, 100.0},
         "... if the point is no farther from it than this, in the plane's width: a post before a "
         "wall is not the wall.");
  b->Add("map.plane.half_weight_thickness_m", plane.half_weight_thickness_m,
         Range<double>{1e-4, 100.0},
         "A plane of this thickness weighs half as much as a thin one.");
}

}  // namespace trajlo
