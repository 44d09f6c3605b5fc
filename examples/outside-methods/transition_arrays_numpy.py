#!/usr/bin/env python3
"""Two joins of clips on numpy arrays. The wanted clip begins at once.

Options: `join`, "crossfade" (both clips continue, and a smoothstep blends their positions) or "inertialisation" (the
new clip is shown, and its offset from the old clip decays by a quintic: Bollo 2016); `blend_s`, the blend length in
seconds (0.33). Blended positions change the lengths of limbs; these are corrected from the hip centre outwards.
"""
import etude
import numpy as np


def placed(poses, frame, onto, hips):
    """Returns the poses turned about the vertical and moved on the floor, so that pose `frame` gets the heading and
    the hip centre's place of the pose `onto`. hips: the indices of hip centre, left and right hip."""
    centre, left, right = hips

    def heading(pose):
        x, _, z = pose[left] - pose[right]
        return np.arctan2(z, x)

    turn = heading(onto) - heading(poses[frame])
    c, s = np.cos(turn), np.sin(turn)
    moved = (poses - poses[frame, centre]) @ np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    moved += [onto[centre, 0], 0, onto[centre, 2]]
    moved[..., 1] = poses[..., 1]
    return moved


def crossfade(old, new, _, t):
    """Blends the two clips, each frames × joints × 3; t is each frame's position in the blend, 0…1."""
    weight = (t * t * (3 - 2 * t))[:, None, None]
    return (1 - weight) * old + weight * new


def inertialisation(_, new, lag, t):
    """lag: the offsets of the old clip from the new one, 2 × joints × 3, in the frame before the change and at the
    change; the seconds between these frames; and the blend length in seconds."""
    offsets, frame_s, blend_s = lag
    x0 = np.linalg.norm(offsets[1], axis=-1)
    along = offsets[1] / np.maximum(x0, 1e-9)[:, None]
    v0 = np.minimum((x0 - (offsets[0] * along).sum(axis=-1)) / frame_s, 0)  # no offset may grow at first
    end = np.minimum(blend_s, np.where(v0 < 0, -5 * x0 / np.where(v0 < 0, v0, 1), blend_s)) + 1e-9
    a0 = np.maximum((-8 * v0 * end - 20 * x0) / end ** 2, 0)
    a = -(a0 * end ** 2 + 6 * v0 * end + 12 * x0) / (2 * end ** 5)
    b = (3 * a0 * end ** 2 + 16 * v0 * end + 30 * x0) / (2 * end ** 4)
    c = -(3 * a0 * end ** 2 + 12 * v0 * end + 20 * x0) / (2 * end ** 3)
    s = np.minimum(t[:, None] * blend_s, end)
    left = ((((a * s + b) * s + c) * s + a0 / 2) * s + v0) * s + x0
    return new + np.where(s < end, left, 0)[..., None] * along


JOINS = {"crossfade": crossfade, "inertialisation": inertialisation}


@etude.method(task="transition", name="transition-arrays-numpy", version="1.0")
class Arrays:
    def __init__(self, setting, options):
        self.join, self.blend_s = JOINS[options.get("join", "inertialisation")], options.get("blend_s", 0.33)
        self.frame_s = 1 / setting.rate_hz
        self.clips = [np.array(clip.poses).reshape(len(clip.poses), -1, 3) for clip in setting.clips]
        self.hips = [setting.joints.index(name) for name in ("hip_centre", "left_hip", "right_hip")]
        self.parents = [setting.joints.index(name) if name else None for name in setting.parents]
        pose = self.clips[0][0]
        self.lengths = [0 if parent is None else np.linalg.norm(pose[joint] - pose[parent])
                        for joint, parent in enumerate(self.parents)]

    def with_limbs(self, poses):
        """Returns the poses with the limb lengths of the character."""
        fixed = poses.copy()
        for joint, parent in enumerate(self.parents):
            if parent is not None:
                limb = poses[:, joint] - poses[:, parent]
                length = np.maximum(np.linalg.norm(limb, axis=-1, keepdims=True), 1e-9)
                fixed[:, joint] = fixed[:, parent] + limb / length * self.lengths[joint]
        return fixed

    def answer(self, problem):
        old, new, leave = self.clips[problem.from_], self.clips[problem.to], problem.request_frame
        new = placed(new, 0, old[leave], self.hips)
        count = max(1, min(round(self.blend_s / self.frame_s), len(new) - 2))
        steps = np.arange(1, count + 1)
        offsets = np.stack([old[max(leave - 1, 0)] - new[0], old[leave] - new[0]])
        shown = self.join(old[np.minimum(leave + steps, len(old) - 1)], new[steps], (offsets, self.frame_s, self.blend_s),
                          steps / count)
        return {"leave_frame": leave, "enter_frame": count,
                "between": self.with_limbs(shown).reshape(count, -1).tolist()}


if __name__ == "__main__":
    etude.serve(Arrays)
