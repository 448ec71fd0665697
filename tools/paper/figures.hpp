// The paper's figures as this program draws them.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tools/figures/figure.hpp"
#include "tools/paper/missions.hpp"
#include "tools/render/pictures.hpp"

namespace gnbv {

/// A picture of a figure.
struct FigureFile {
  std::string path;   // below the page's folder: "figures/fig08-path-proposed.png"
  std::string label;  // what tells it from the others
};

class FigureDesk;

/// A figure of the paper, and how it becomes ours.
struct FigureKind {
  std::string_view number;                   // "8"
  std::vector<std::string_view> scenarios;   // of which the first that was asked for is drawn
  std::string_view paper;                    // what the paper's figure shows, in our words
  std::string_view ours;                     // what ours shows, and how that differs
  void (*draw)(FigureDesk& desk) = nullptr;  // throws BadInput for what cannot be drawn
};

/// In the paper's order.
const std::vector<FigureKind>& figure_kinds();

/// A figure of the paper that no mission can show.
struct UndrawnFigure {
  std::string_view number;
  std::string_view why;  // one sentence: what it is, and what of ours stands for it
};
const std::vector<UndrawnFigure>& undrawn_figures();

struct DrawnFigure {
  const FigureKind* kind = nullptr;
  std::string scenario;  // of which it is
  std::vector<FigureFile> files = {};
  std::vector<std::string> missing = {};  // a sentence each: what it does not show, and why
};

/// Where a figure is drawn: the missions, and the files it leaves.
class FigureDesk {
 public:
  FigureDesk(const PaperMaterial& material, std::filesystem::path folder, int threads);
  ~FigureDesk();

  const PaperMaterial& material() const { return material_; }
  int threads() const { return threads_; }
  /// Throws BadInput as Renderer does.
  Renderer& renderer();

  /// Begins a figure; what is written from here on is of it.
  void begin(const FigureKind& kind, const std::string& scenario);
  const DrawnFigure& figure() const { return figure_; }

  /// The first seed's mission of a utility in the figure's scenario. Throws BadInput when there is
  /// none.
  const PaperMission& mission(std::string_view utility) const;
  RunSource& source(std::string_view utility);

  /// "fig08-WHAT.png", by rename.
  void add(const std::string& what, const std::string& label, const Image& image);
  /// "fig08-WHAT.svg".
  void add(const std::string& what, const std::string& label, const Figure& figure);
  void miss(const std::string& sentence) { figure_.missing.push_back(sentence); }

 private:
  std::string file_of(const std::string& what, const char* ending) const;

  const PaperMaterial& material_;
  std::filesystem::path folder_;
  int threads_ = 1;
  std::unique_ptr<Renderer> renderer_;  // only what is drawn in 3D needs one
  DrawnFigure figure_;
  std::map<std::pair<std::string, std::string>, std::unique_ptr<RunSource>> sources_;
};

/// Draws every figure whose scenario was asked for into FOLDER/figures. What cannot be drawn is
/// named in `missing`. `progress` is told before each.
std::vector<DrawnFigure> draw_figures(
    const PaperMaterial& material, const std::filesystem::path& folder, int threads,
    const std::function<void(std::size_t done, std::size_t all, const std::string& figure)>&
        progress);

// How they are drawn; figure_drawings.cpp.
void draw_rays_figure(FigureDesk& desk);            // Fig. 2
void draw_profile_figure(FigureDesk& desk);         // Fig. 4
void draw_scales_figure(FigureDesk& desk);          // Fig. 5
void draw_frontiers_figure(FigureDesk& desk);       // Fig. 6
void draw_paths_figure(FigureDesk& desk);           // Figs 8, 10
void draw_densities_figure(FigureDesk& desk);       // Fig. 9
void draw_entropy_figure(FigureDesk& desk);         // Figs 11, 14, 17
void draw_path_in_map_figure(FigureDesk& desk);     // Figs 13, 16
void draw_reconstruction_figure(FigureDesk& desk);  // Figs 15, 18

}  // namespace gnbv
