#pragma once

#include <map>
#include <string>

#include "apps/viewer/thumbnails.h"
#include "apps/viewer/view_state.h"
#include "prt/gpu/gl_name.h"

namespace prt::viewer {

/// The images beside a light of the view, to choose another.
class LightFolder {
  public:
    /// Lays them out in the window of Dear ImGui that is being made. A click puts an image in the
    /// place of the first light that is a file, or adds it where there is none.
    void draw(ViewState& view);

    /// Whether there is more to come than was drawn last.
    bool isBusy() const;

  private:
    void drawPictures(ViewState& view);
    unsigned textureOf(const Thumbnail& thumbnail);

    std::string folder_;
    Thumbnails thumbnails_;
    std::map<std::string, GlName> textures_;  ///< by Thumbnail::source
    bool isDrawn_ = false;
};

/// The folder of the first light of a view that is a file; empty without one.
std::string lightFolderOf(const ViewState& view);

/// Lets a file be the light in place of the first that is a file, whose stops and azimuth it keeps.
void chooseLight(ViewState& view, const std::string& file);

}  // namespace prt::viewer
