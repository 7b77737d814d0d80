// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <utility>
#include <vector>

namespace trajlo {

/// Throws OutputError if `folder` is none, or if it holds one of `files`: an earlier result if the
/// first of them, its summary, is there, and then only if `overwrite` is false. Creates and changes
/// nothing.
void CheckResultFolder(const std::filesystem::path& folder,
                       const std::vector<std::filesystem::path>& files, bool overwrite);
/// Creates the folder and removes `files`, the first one last, so that no part of an earlier result
/// survives beside the new one. Links are left alone: somebody wants the file elsewhere, and
/// writing follows them. Throws OutputError.
void PrepareResultFolder(const std::filesystem::path& folder,
                         const std::vector<std::filesystem::path>& files);

/// The folder that a run writes its results to, and the names of the files in it.
class ResultFolder {
 public:
  explicit ResultFolder(std::filesystem::path path) : path_(std::move(path)) {}

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path trajectory() const { return path_ / "trajectory.tum"; }
  std::filesystem::path map() const { return path_ / "map.ply"; }
  /// A thinned choice of the scans, for pictures.
  std::filesystem::path view() const { return path_ / "view.ply"; }
  std::filesystem::path windows() const { return path_ / "windows.csv"; }
  /// What can be said against each pose of the trajectory.
  std::filesystem::path flags() const { return path_ / "flags.csv"; }
  /// Only if it was asked for.
  std::filesystem::path covariance() const { return path_ / "covariance.csv"; }
  /// Where the LiDARs were found to be, if there are several.
  std::filesystem::path rig() const { return path_ / "rig.yaml"; }
  /// The factor graphs of windows, if they were asked for: see core/graph.
  std::filesystem::path graphs() const { return path_ / "windows"; }
  std::filesystem::path config() const { return path_ / "config.yaml"; }
  std::filesystem::path summary() const { return path_ / "run.json"; }

  void Check(bool overwrite) const { CheckResultFolder(path_, Files(), overwrite); }
  /// Removes an earlier result, and what was drawn or evaluated from it.
  void Prepare() const;

 private:
  std::vector<std::filesystem::path> Files() const {
    return {summary(), trajectory(), map(),        view(),  windows(),
            flags(),   rig(),        covariance(), config()};
  }

  std::filesystem::path path_;
};

}  // namespace trajlo
