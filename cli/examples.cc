#include "cli/examples.h"

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace etude {
namespace {

/// Returns lines to be typed, by the words of a command without "etude".
const std::map<std::string_view, std::vector<std::string_view>>& ExamplesByCommand() {
  static const std::map<std::string_view, std::vector<std::string_view>> examples = {
      {"run", {"etude run quick", "etude run full/ik_weights --trials 50 -o out/try", "etude run mine.yaml --resume"}},
      {"scenario", {"etude scenario copy quick mine", "etude scenario copy full/ik_weights .", "etude list scenarios"}},
      {"list", {"etude list scenarios", "etude list methods", "etude list metrics"}},
      {"clip",
       {"etude clip info walk.bvh", "etude clip render walk.bvh -o walk.mp4", "etude clip convert walk.bvh walk.glb"}},
      {"sensor",
       {"etude sensor stats take.txt", "etude sensor fit take.txt --reference optical.csv -o mine.yaml",
        "etude sensor sheet scenario.yaml -o sheet.png"}},
      {"list recordings", {"etude list recordings", "etude list recordings > recordings.md", "etude rows out/quick-1"}},
      {"scenario copy",
       {"etude scenario copy full/ik_weights .", "etude scenario copy quick mine",
        "etude scenario copy paper/coach ."}},
      {"merge",
       {"etude merge part-1 part-2 -o out/whole", "etude merge shards/* -o out/quick --overwrite",
        "etude merge out/quick-1-*-of-8 -o out/quick"}},
      {"report",
       {"etude report out/quick-1", "etude report out/quick-1 --no-video",
        "etude report out/quick-1 --whole-sessions"}},
      {"rows",
       {"etude rows out/many -o many.jsonl", "etude rows out/quick-1 | head -3", "etude rows out/copied --unsealed"}},
      {"replay",
       {"etude replay out/quick-1 --sample 20",
        "etude replay out/quick-1 --cell ik-weights/joint_noise_deg=5/003/fixed --pack cell.etude",
        "etude replay cell.etude"}},
      {"verify",
       {"etude verify out/quick-1", "etude verify out/quick-1 --sample 100 --sign ~/.minisign/minisign.key",
        "etude verify results --check minisign.pub"}},
      {"cite", {"etude cite out/quick-1", "etude cite out/quick-1 > etude.bib", "etude cite results/paper-table-2"}},
      {"gate",
       {"etude gate out/ci --baseline baseline.json", "etude gate out/ci --baseline baseline.json --update",
        "etude gate mine.yaml --self-test --repetitions 10"}},
      {"compare",
       {"etude compare out/before out/after", "etude compare out/quick-1 out/quick-2",
        "etude compare out/here out/copied --unsealed"}},
      {"export",
       {"etude export quick/ik -o problems", "etude export full/capture_rivals -o films --films --trials 2",
        "etude export mine.yaml -o problems --seed 7"}},
      {"score",
       {"etude score problems answers -o out/mine --name mine", "etude score problems answers -o out/mine --alone",
        "etude score quick/ik answers -o out/mine --allow-missing"}},
      {"check-method",
       {"etude check-method --task ik -- python3 ik_dls.py",
        "etude check-method --task coach --seat recogniser -- python3 mine.py",
        "etude check-method --task capture --time 60 -- ./capture"}},
      {"list methods", {"etude list methods", "etude list methods | less", "etude list methods | grep -A9 transition"}},
      {"list clips",
       {"etude list clips", "etude clip render builtin:groove -o groove.mp4", "etude clip info builtin:acts"}},
      {"list scenarios", {"etude list scenarios", "etude list scenarios quick", "etude list scenarios mine/"}},
      {"list metrics",
       {"etude list metrics", "etude list metrics --json > metrics.json", "etude list metrics --markdown"}},
      {"list keys",
       {"etude list keys", "etude list keys --schema > scenario.schema.json", "etude list keys --markdown"}},
      {"clip info",
       {"etude clip info walk.bvh", "etude clip info 'mocap/*.bvh' --json",
        "etude clip info dance.glb#Samba --unit cm"}},
      {"clip convert",
       {"etude clip convert walk.bvh walk.glb", "etude clip convert walk.bvh walk.csv --trim 1.5:4",
        "etude clip convert builtin:groove groove.glb --character bear"}},
      {"clip render",
       {"etude clip render walk.bvh -o walk.mp4", "etude clip render 'mocap/*.bvh' -o mocap.png",
        "etude clip render dance.glb -o dance.mp4 --view side"}},
      {"clip contacts",
       {"etude clip contacts walk.bvh -o walk.svg", "etude clip contacts builtin:groove -o groove.svg",
        "etude clip contacts dance.glb#Jump -o jump.svg --overwrite"}},
      {"clip map",
       {"etude clip map walk.bvh", "etude clip map odd.bvh -o map.yaml",
        "etude clip map odd.bvh --joint-map map.yaml"}},
      {"clip grades",
       {"etude clip grades walk.bvh", "etude clip grades walk.bvh -o grades.csv",
        "etude clip grades 'mocap/*.bvh' --fuzzy mine.yaml"}},
      {"bridge",
       {"etude bridge 'mocap/*.bvh' -o tags.xml", "etude bridge 'mocap/*.bvh' --json",
        "etude bridge 'mocap/*.bvh' --check tags.xml"}},
      {"train",
       {"etude train 'mocap/*.bvh' -o fuzzy.yaml", "etude train 'builtin:*' -o fuzzy.yaml --method adaptive",
        "etude train 'builtin:*' -o learnt.yaml --recogniser"}},
      {"teach",
       {"etude teach takes/*.txt --labels labels.csv -o moves.yaml", "etude teach wave.bvh bow.bvh -o moves.yaml",
        "etude teach takes/ --labels tags/ -o moves.yaml --format kinect-v1"}},
      {"recognise",
       {"etude recognise new.txt --moves moves.yaml",
        "device | etude recognise - --moves moves.yaml --format kinect-v2",
        "etude recognise takes/ --labels labels.csv --leave-one-person-out"}},
      {"sensor stats",
       {"etude sensor stats take.txt", "etude sensor stats take.txt --reference optical.csv",
        "etude sensor stats take.txt --reference optical.csv --simulate v2"}},
      {"sensor fit",
       {"etude sensor fit take.txt --reference optical.csv -o mine.yaml",
        "etude sensor fit take.txt --reference optical.csv -o mine.yaml --base v1",
        "etude sensor fit take.txt --reference optical.csv -o mine.yaml --steps 3"}},
      {"sensor sheet",
       {"etude sensor sheet scenario.yaml -o sheet.png", "etude sensor sheet scenario.yaml -o sheet.png --seed 3",
        "etude sensor sheet scenario.yaml -o sheet.png --clips walk.bvh"}},
      {"calibrate",
       {"etude calibrate --print board.png", "etude calibrate left/ right/ -o rig.yaml",
        "etude calibrate points.csv --size 1920x1080 -o rig.yaml"}},
      {"capture",
       {"etude capture --rig rig.yaml left.mp4 right.mp4 --keypoints json/ -o motion.bvh",
        "etude capture --rig rig.yaml left.mp4 right.mp4 --silhouettes -o motion.bvh",
        "etude capture --rig rig.yaml left.mp4 right.mp4 --marks marks/ -o motion.trc"}},
      {"coach",
       {"etude coach first-steps --stream - --format kinect-v2", "etude coach song.yaml --stream take.txt --brief",
        "etude coach song.yaml --stream - --click click.wav"}},
      {"crowd",
       {"etude crowd", "etude crowd -o crowd.mp4 --seconds 10", "etude crowd --characters 200 --rate 120 --float"}},
      {"completion",
       {"etude completion bash > ~/.local/share/bash-completion/completions/etude",
        "etude completion zsh > ~/.zfunc/_etude", "etude completion fish > ~/.config/fish/completions/etude.fish"}},
  };
  return examples;
}

void AddTo(CLI::App& command, const std::string& words, const std::string& inherited) {
  std::string footer = command.get_footer() == inherited ? "" : command.get_footer();
  if (const auto own = ExamplesByCommand().find(words); own != ExamplesByCommand().end()) {
    if (!footer.empty()) footer += "\n\n";
    footer += "Examples:";
    for (const std::string_view line : own->second) footer += "\n  " + std::string(line);
  }
  command.footer(footer);
  for (CLI::App* sub : command.get_subcommands([](const CLI::App* one) { return !one->get_name().empty(); })) {
    AddTo(*sub, words + " " + sub->get_name(), inherited);
  }
}

}  // namespace

void AddExamples(CLI::App& app) {
  for (CLI::App* command : app.get_subcommands([](const CLI::App* one) { return !one->get_name().empty(); })) {
    AddTo(*command, command->get_name(), app.get_footer());
  }
}

}  // namespace etude
