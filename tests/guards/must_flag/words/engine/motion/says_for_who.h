/// Returns the move for who asks.
