"""Task spaces of several arms."""
