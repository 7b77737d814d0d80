// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <utility>

namespace trajlo {

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
  std::filesystem::path config() const { return path_ / "config.yaml"; }
  std::filesystem::path summary() const { return path_ / "run.json"; }

  /// Throws OutputError if the path is no folder, or if it holds a result and `overwrite` is
  /// false. Creates and changes nothing.
  void Check(bool overwrite) const;
  /// Creates the folder and removes an earlier result, so that no part of it survives beside the
  /// new one. Throws OutputError.
  void Prepare() const;

 private:
  std::filesystem::path path_;
};

}  // namespace trajlo
