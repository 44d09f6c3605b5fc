// Takes every so many frames.
