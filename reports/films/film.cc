#include "reports/films/film.h"

#include "bench/files/files.h"
#include "reports/films/encoder.h"
#include "reports/films/look.h"

namespace etude {
namespace {

Result<std::string> Encode(Scene& scene, const std::filesystem::path& path) {
  ASSIGN_OR_RETURN(auto encoder, Encoder::Start(path, kFilmWidth, kFilmHeight, kFilmRate));
  for (int frame = 0; frame < scene.Frames(); ++frame) {
    RETURN_IF_ERROR(encoder.Add(scene.Draw(frame).Pixels()));
  }
  RETURN_IF_ERROR(encoder.Finish());
  return ReadWholeFile(path);
}

}  // namespace

Canvas BeginFrame(const std::string& heading) {
  Canvas canvas(kFilmWidth, kFilmHeight);
  canvas.FillBox({0, 0, kFilmWidth, kFilmHeight}, kBackdrop);
  canvas.DrawText({16, 34}, "Etude", 20, kInk, 120, true);
  canvas.DrawText({92, 33}, heading, 17, kSoftInk, kFilmWidth - 108);
  return canvas;
}

Picture PictureOf(const Canvas& canvas, std::string caption) {
  return {canvas.Png(), canvas.width(), canvas.height(), std::move(caption)};
}

Film Shoot(Scene& scene, const std::filesystem::path& path) {
  Film film;
  film.file = path.filename().string();
  film.poster = PictureOf(scene.Draw(scene.PosterFrame()), scene.Words());
  if (auto mp4 = Encode(scene, path)) {
    film.mp4 = std::move(*mp4);
  } else {
    film.why_not = "There is no film, only this picture: " + ToString(mp4.error());
  }
  return film;
}

}  // namespace etude
