-- What full credit was worth when a mark was set by hand: the mark follows when the assignment's points change.
ALTER TABLE mark_override ADD COLUMN points_of DOUBLE PRECISION;
