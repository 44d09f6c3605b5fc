/// The exhibit of a world.
